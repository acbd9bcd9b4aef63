# SPDX-License-Identifier: Apache-2.0
"""Robots, controlled by components, as a library.

    import armature

    deployment = armature.load("robots/janus/deployments/pid.yaml", set={"PID1.Kp": 200})
    with deployment.application() as app:
        app.run_for("100 ms")           # simulated time
        app.Arming.arm()
        app.Generator.moveTo([1.0, 1.0], 10.0)
        print(app.Joint1.Position.value, app.Joint1.Position.unit)

Values are in the units of their models, times in seconds. Mistakes are exceptions: of deployments a
`DeploymentError` with the place of each, of everything that an application refuses an `Error`.
Nothing here runs in a real-time thread.
"""
from armature._application import Application, RunEnd
from armature._component import RunningComponent
from armature._connection import Connection, connect
from armature._deployment import Deployment, check, load
from armature._errors import DeploymentError, RunError
from armature._members import Command, CommandError, Event, Input, Operation, Output, Port, Property
from armature._native import Diagnostic, Error, LogLine, NoAnswer, Refusal
from armature._recording import Recording, Samples, read_recording
from armature._values import Struct
from armature.author import Component

__all__ = [
    "Application",
    "Command",
    "CommandError",
    "Component",
    "Connection",
    "Deployment",
    "DeploymentError",
    "Diagnostic",
    "Error",
    "Event",
    "Input",
    "LogLine",
    "NoAnswer",
    "Operation",
    "Output",
    "Port",
    "Property",
    "Recording",
    "Refusal",
    "RunEnd",
    "RunError",
    "RunningComponent",
    "Samples",
    "Struct",
    "check",
    "connect",
    "load",
    "read_recording",
]

for _exception in (NoAnswer, Refusal):
    _exception.__module__ = "armature"
del _exception

from armature.sweeps import sweep  # noqa: E402  # with __all__ below, in lines of their own
