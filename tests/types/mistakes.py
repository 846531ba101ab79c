"""A program with mistakes that a type checker finds, each in a line that says so; it is never run."""

import bbsd
from bbsd.api import Designd  # wrong

bbsd.desing("minimal.yaml")  # wrong
bbsd.design("minimal.yaml", sed=1)  # wrong
bbsd.evaluate("minimal.yaml", episodes="1000")  # wrong
bbsd.evaluate("minimal.yaml").returned  # wrong
mean: str = bbsd.evaluate("minimal.yaml").mean  # wrong
bbsd.Agent("minimal.yaml").act("position")  # wrong
bbsd.trace("minimal.yaml", episode="wurst")  # wrong
print(bbsd.evaluate("minimal.yaml").mean, Designd)
