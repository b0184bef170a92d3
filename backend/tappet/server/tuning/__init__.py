"""Tuning of the position loop of an axis: a measurement of the running axis, figures, a model and gains.

Start with `routes`. The step itself is made in the controller (`AxisPanel`), by whoever has control there;
what the record says is computed in a process of its own.
"""
