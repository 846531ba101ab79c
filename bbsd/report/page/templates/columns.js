// The columns of an episode as the page holds them: plain {v: [...]}, or in stretches {r: [value, length, ...]};
// with words {w: [...]} the values are places in them.

function unpacked(column) {
  let values = column.v;
  if (column.r) {
    values = [];
    for (let at = 0; at < column.r.length; at += 2) {
      for (let left = column.r[at + 1]; left > 0; left -= 1) values.push(column.r[at]);
    }
  }
  return column.w ? values.map((value) => column.w[value]) : values;
}

// Stretches of equal values as [value, first, last], both places included.
function stretches(values) {
  const found = [];
  values.forEach((value, place) => {
    const last = found[found.length - 1];
    if (last && last[0] === value) last[2] = place;
    else found.push([value, place, place]);
  });
  return found;
}

// An episode with its columns unpacked, once it is looked at.
const opened = new Map();
function episodeOf(packed) {
  if (!opened.has(packed)) {
    opened.set(packed, {
      ...packed,
      values: packed.values.map((each) => ({ ...each, column: unpacked(each.column) })),
      controlling: packed.controlling.map(unpacked),
      actions: packed.actions.map(unpacked),
      excited: packed.excited.map((robot) => robot.map(unpacked)),
      cells: packed.cells.map((robot) => robot.map(unpacked)),
      wishes: packed.wishes.map((robot) => robot.map(unpacked)),
      expectations: packed.expectations.map(unpacked),
      rewards: packed.rewards.map((term) => ({ ...term, robots: term.robots.map(unpacked) })),
    });
  }
  return opened.get(packed);
}
