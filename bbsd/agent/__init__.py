"""What an agent is made of: what it must be given, and its program, written from what it needs."""

from bbsd.agent.inputs import AgentInput, BadInput
from bbsd.agent.program import Act

__all__ = ["Act", "AgentInput", "BadInput"]
