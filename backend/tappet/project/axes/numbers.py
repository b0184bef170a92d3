"""Numbers as settings of axes may be."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field, StrictInt

Number = Annotated[float, Field(allow_inf_nan=False)]
Positive = Annotated[float, Field(gt=0, allow_inf_nan=False)]
NotNegative = Annotated[float, Field(ge=0, allow_inf_nan=False)]
Count = Annotated[StrictInt, Field(ge=1, le=2**31 - 1)]
