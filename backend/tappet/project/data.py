"""What the data of all object kinds have in common."""

from pydantic import BaseModel, ConfigDict


class Data(BaseModel):
    """Base of the data of all object kinds: frozen, and nothing unknown is swallowed."""

    model_config = ConfigDict(frozen=True, extra="forbid", ser_json_inf_nan="null")
