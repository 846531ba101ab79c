"""A page on a design in a real browser: it draws itself, replays, can be used by all, and reaches for nothing."""

import json
from pathlib import Path

import pytest
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

pytestmark = pytest.mark.slow

AXE = (Path(__file__).parent / "axe-core-4.11.0" / "axe.min.js").read_text(encoding="utf-8")

LOOK = """
const slider = document.getElementById("step");
const at = (step) => {
  slider.value = step;
  slider.dispatchEvent(new Event("input"));
  return {
    shown: document.getElementById("step-shown").textContent,
    controlling: [...document.querySelectorAll("#robots .controlling")].map((each) => each.textContent),
    actions: [...document.querySelectorAll("#robots .does")].map((each) => each.textContent),
    layers: [...document.querySelectorAll(".layers > li")].map((each) => [each.dataset.behavior, each.dataset.state]),
  };
};
return Array.from({length: Number(slider.max)}, (_, index) => at(index + 1));
"""
OPEN_ALL = "for (const each of document.querySelectorAll('details')) each.open = true;"


def step_shown(browser):
    return int(browser.find_element(By.ID, "step-shown").text.split()[1])


def look(browser, rank):
    browser.execute_script(f"document.querySelectorAll('input[name=episode]')[{rank}].click();")
    return browser.execute_script(LOOK)


@pytest.mark.parametrize("rank", [0, 1, 2])
@pytest.mark.parametrize("name", ["lifting", "pursuit", "mobile"])
def test_the_replay_shows_who_controlled_in_the_trace_at_every_step(browser, opened, name, rank):
    trace = opened(name).replays[rank].trace
    seen = look(browser, rank)
    assert [step["shown"] for step in seen] == [
        f"step {step} of {len(trace.steps)}" for step in trace.steps.tolist()
    ]
    assert [step["controlling"] for step in seen] == [
        [*names] for names in zip(*trace.controlling, strict=True)
    ]
    assert [step["actions"] for step in seen] == [[*names] for names in zip(*trace.actions, strict=True)]


@pytest.mark.parametrize("name", ["lifting", "pursuit"])
def test_layers_say_what_they_wanted_and_what_became_of_it(browser, opened, name):
    page = opened(name)
    decisions, names = page.replays[0].trace.decisions, [*page.loaded.spec.behaviors]
    for at, step in enumerate(look(browser, 0)):
        for behavior, state in step["layers"]:
            index = names.index(behavior)
            excited, wish = decisions.excited[at, 0, index], decisions.wishes[at, 0, index]
            controls = decisions.controlling[at, 0] == index
            expected = "controls" if controls else "suppressed" if wish else "leaves"
            assert state == (expected if excited else "calm")


def test_the_rule_that_decides_lights_up(browser, opened):
    opened("lifting")
    browser.execute_script(OPEN_ALL)
    lit = "return [...document.querySelectorAll('.rules [aria-current]')].map((each) => each.textContent)"
    browser.execute_script(
        "const s = document.getElementById('step'); s.value = 300; s.dispatchEvent(new Event('input'))"
    )
    assert browser.execute_script(lit)[0] == "stop where reached"
    assert "stop where reached" in browser.find_element(By.ID, "why").text


def test_the_replay_is_led_by_keyboard(browser, opened):
    opened("pursuit")
    slider = browser.find_element(By.ID, "step")
    assert step_shown(browser) == 1
    slider.send_keys(Keys.ARROW_RIGHT, Keys.ARROW_RIGHT)
    assert step_shown(browser) == 3
    slider.send_keys(Keys.END)
    assert step_shown(browser) == int(slider.get_attribute("max"))
    slider.send_keys(Keys.HOME)
    browser.execute_script("document.activeElement.blur()")
    browser.find_element(By.TAG_NAME, "body").send_keys(Keys.ARROW_RIGHT)
    assert step_shown(browser) == 2
    browser.find_element(By.CSS_SELECTOR, "input[name=robot]").send_keys(Keys.ARROW_DOWN)
    assert browser.find_element(By.ID, "why").text.startswith("Step 2, robot 1: ")
    play = browser.find_element(By.ID, "play")
    play.send_keys(Keys.SPACE)
    assert play.text == "Pause"
    play.send_keys(Keys.SPACE)
    assert play.text == "Play"


def test_a_pointer_over_the_bands_passes_through_the_steps(browser, opened):
    from selenium.webdriver import ActionChains

    opened("lifting")
    bands = browser.find_element(By.ID, "bands")
    ActionChains(browser).move_to_element(bands).perform()
    assert step_shown(browser) in {150, 151}
    ActionChains(browser).move_to_element(browser.find_element(By.TAG_NAME, "h1")).perform()
    assert step_shown(browser) == 1
    ActionChains(browser).move_to_element(bands).click().perform()
    ActionChains(browser).move_to_element(browser.find_element(By.TAG_NAME, "h1")).perform()
    assert step_shown(browser) in {150, 151}


@pytest.mark.parametrize("theme", ["light", "dark"])
@pytest.mark.parametrize("name", ["run", "pursuit"])
def test_nobody_is_left_out(browser, opened, name, theme):
    opened(name, theme)
    browser.execute_script(OPEN_ALL)
    browser.execute_script(AXE)
    found = browser.execute_async_script(
        "axe.run({resultTypes: ['violations']}).then((each) => arguments[0](each))"
    )
    violations = [
        (each["id"], [node["html"][:120] for node in each["nodes"]][:3]) for each in found["violations"]
    ]
    assert violations == []
    assert len(found["passes"]) > 20


@pytest.mark.parametrize("name", ["run", "pursuit", "mobile"])
def test_on_a_phone_nothing_is_wider_than_the_screen(browser, opened, name):
    opened(name, width=360)
    browser.execute_script(OPEN_ALL)
    wide = browser.execute_script("""
      const inside = (each) => each.closest(".scrolling") && !each.matches(".scrolling");
      return [...document.querySelectorAll("body *")]
        .filter((each) => !inside(each) && !each.matches(".skip") && each.getBoundingClientRect().right > 360.5)
        .map((each) => each.outerHTML.slice(0, 120));
    """)
    assert wide == []
    assert browser.execute_script("return document.documentElement.scrollWidth") == 360


@pytest.mark.parametrize("name", ["run", "pursuit"])
def test_the_console_is_empty_and_no_request_leaves(browser, opened, made, name):
    opened(name)
    browser.execute_script(OPEN_ALL)
    browser.find_element(By.ID, "step").send_keys(Keys.ARROW_RIGHT)
    assert browser.get_log("browser") == []
    messages = [json.loads(entry["message"])["message"] for entry in browser.get_log("performance")]
    urls = [
        each["params"]["request"]["url"] for each in messages if each["method"] == "Network.requestWillBeSent"
    ]
    assert [url for url in urls if not url.startswith("data:")] == [made(name)[1].as_uri()]


def test_a_run_shows_how_it_was_found_what_was_designed_and_what_its_parts_are_worth(browser, opened):
    page = opened("run")
    titles = [each.text for each in browser.find_elements(By.TAG_NAME, "h2")]
    assert titles == [
        "What it does, and why",
        "What it earns",
        "What each part is worth",
        "When something fails",
        "Beside object_lifting_hand.yaml",
        "How it was found",
        "The spec",
        "How to repeat it",
    ]
    designed = [
        each.text.strip() for each in browser.find_elements(By.CSS_SELECTOR, ".listing .designed code")
    ]
    assert designed.count("rules:") == 5
    assert any(line.startswith("structure: [") for line in designed)
    assert not any("budget" in line or "generations" in line for line in designed)
    (random,) = [
        each for each in browser.find_elements(By.CSS_SELECTOR, ".facts div") if "random" in each.text
    ]
    assert f"{abs(page.run.random.mean):.1f}" in random.text
    assert len(browser.find_elements(By.CSS_SELECTOR, "#progress canvas")) == 1


def test_a_table_behind_a_figure_has_its_numbers(browser, opened):
    page = opened("run")
    browser.execute_script(OPEN_ALL)
    rows = browser.execute_script("""
      const tables = [...document.querySelectorAll("#returns table")];
      const table = tables.find((each) => each.caption.textContent === "Episodes by their return");
      return [...table.tBodies[0].rows].map((row) => Number(row.cells[1].textContent));
    """)
    assert sum(rows) == len(page.returns)


def test_an_address_can_name_an_episode_a_robot_and_a_step(browser, opened):
    trace = opened("pursuit", place="#episode=best&robot=2&step=9").replays[2].trace
    assert step_shown(browser) == 9
    assert browser.find_element(By.ID, "why").text.startswith(f"Step 9, robot 2: {trace.controlling[2][8]} ")
    opened("pursuit", place="#episode=none&robot=77&step=1e9")
    assert step_shown(browser) == int(browser.find_element(By.ID, "step").get_attribute("max"))


def test_texts_of_a_spec_are_shown_and_do_nothing(browser, opened):
    page = opened("sneaky")
    assert browser.find_element(By.CSS_SELECTOR, ".summary").text == page.loaded.spec.summary
    assert browser.execute_script("return [window.ran, document.images.length]") == [None, 0]
    listed = browser.find_element(By.CSS_SELECTOR, ".listing").get_attribute("textContent")
    assert "<script>window.ran = 1</script>" in listed
    assert browser.get_log("browser") == []


def test_the_command_for_a_step_is_that_of_bbsd_why(browser, opened):
    page = opened("pursuit", place="#robot=2&step=9")
    expected = f"bbsd why pursuit_hand.yaml --episode {page.replays[0].number} --step 9 --robot 2"
    assert browser.find_element(By.ID, "ask").text == expected


def test_who_wants_less_motion_gets_it(browser, opened):
    opened("lifting")
    smooth = "return getComputedStyle(document.documentElement).scrollBehavior"
    assert browser.execute_script(smooth) == "smooth"
    calm = [{"name": "prefers-reduced-motion", "value": "reduce"}]
    browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": calm})
    assert browser.execute_script(smooth) == "auto"


def test_the_policy_stops_what_would_leave_or_run(browser, opened):
    opened("lifting")
    browser.execute_script("""
      document.body.insertAdjacentHTML(
        "beforeend", '<img src="http://127.0.0.1:9/x.png"><b onclick="window.ran = 1">x</b>');
      const script = document.createElement("script");
      script.textContent = "window.ran = 1";
      document.body.append(script);
      document.querySelector("b[onclick]").click();
    """)
    assert browser.execute_script("return window.ran") is None
    refused = [each["message"] for each in browser.get_log("browser")]
    assert any("x.png" in each and "img-src" in each for each in refused)
