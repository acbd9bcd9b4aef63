// SPDX-License-Identifier: Apache-2.0

export const kDeployments: Record<string, Record<string, string>> = {
  wave: {
    "wave.yaml": `# armature run --sim --for 1s wave.yaml
application: wave
libraries: [wave, controls]
components:
  Source: {model: Source, activity: {periodic: 10 ms, priority: 70}, properties: {Frequency: 2, Amplitude: 0.785}}
  Filter: {model: LowPass, activity: sequential, properties: {Weight: 0.2}}
  Watcher: {model: Watcher, activity: {periodic: 200 ms}}
connections:
  - Source.Position -> Filter.Raw
  - Filter.Filtered -> Watcher.Value
`,
  },
  operated: {
    "operated.yaml": `application: operated
libraries: [robot]
components:
  Generator: {model: AxesGenerator, activity: {periodic: 10 ms}}
  Arming: {model: Arming, activity: {periodic: 10 ms}}
  Hardware: {model: Hardware}
`,
  },
  tool: {
    "tool.yaml": `application: tool
libraries: [robot]
components:
  Planner: {model: PathPlanner, activity: {periodic: 10 ms}}
`,
  },
  arm: {
    "arm.yaml": `# An arm of seven joints on a rover.
include: control.yaml
application: arm
libraries: [robot, controls, chassis]
parameters: {joints: 7}
modes:
  rest: [Lamp]
  work: [Generator]
composites:
  Chassis:
    components:
      mixer: {model: Mixer, properties: {Track: 0.4}}
      left: {model: Wheel}
      right: {model: Wheel}
    connections:
      - mixer.Left -> left.Speed
      - mixer.Right -> right.Speed
    exports:
      ports: {Forward: mixer.Forward, Turn: mixer.Turn, LeftAngle: left.Angle, RightAngle: right.Angle}
components:
  Driver: {model: Driver, activity: {periodic: 10 ms, priority: 60}}
  Rover: {model: Chassis}
  Go: {model: Button}
  Jog: {model: Slider, activity: {periodic: 50 ms}, properties: {High: 2, Unit: rad, Hold: true}}
  Lamp: {model: Light}
  Power: {model: Switch, activity: {periodic: 50 ms}}
  Height: {model: Number, properties: {Unit: rad}}
  Says: {model: Text}
connections:
  - Driver.Forward -> Rover.Forward
  - Driver.Turn -> Rover.Turn
  - Rover.LeftAngle -> Driver.Left
  - Rover.RightAngle -> Driver.Right
  - Power.On -> Lamp.On
  - {on: Go.Pressed, do: Generator.hold, name: Hold}
  - {on: Power.TurnedOn, do: Generator.moveTo, name: Move, with: {target: Sensor.sensor, time: 2 s}}
  - Jog.Out -> Height.Value
`,
    "control.yaml": `# The control of the joints, to be included.
components:
  Joint{1..7}:
    model: Joint
    activity: {periodic: 10 ms, priority: 80}
    peers: [Sampler]
    properties: {PositionMin: -0.5, PositionMax: 4.5, MaxVelocity: 3}
  Sensor: {model: Sensor, activity: sequential}
  Robot: {model: Robot, properties: {robot_description: ../robots/wam7.urdf}}
  Generator: {model: Generator, activity: {periodic: 20 ms, priority: 40}}
  PID{1..7}: {model: PID, activity: sequential, properties: {Kp: 400, Ki: 20}}
connections:
  - Joint{i}.Position -> Sensor.Position{i}
  - Sensor.sensor -> Generator.sensor
  - Generator.Ref{i} -> PID{i}.Ref
  - Joint{i}.Position -> PID{i}.Sen
  - PID{i}.Out -> Joint{i}.Voltage
`,
  },
  vision: {
    "vision.yaml": `include: lamp.yaml
application: vision
libraries: [controls, vision]
modes:
  look: [Vision, Prepare]
  rest:
    - Dial  # is turned meanwhile
components:
  Vision: {model: Camera}
  Prepare:
    model: Sequence
    activity: {periodic: 100 ms}
    superiors: [Dial]
    calls:
      - Vision.initialize  # first of all
      - {call: Vision.setThreshold, with: {low: 10, far: Dial.Out}}
  Ask: {model: Request, activity: {periodic: 100 ms}, calls: Vision.start}
  Dial: {model: Slider, activity: {periodic: 100 ms}}
`,
    "lamp.yaml": "components:\n  Lamp: {model: Light}\n",
  },
  empty: { "new.yaml": "application: new\n" },
  wrong: {
    "wrong.yaml": `application: wrong
libraries: [wave]
components:
  Source: {model: Source, activity: {periodic: 10 ms}}
  Filter: {model: LowPas}
  Watcher: {model: Watcher, activity: {periodic: 200 ms}}
connections:
  - Source.Position -> Watcher.Valu
`,
  },
};

/** A deployment of many boxes, each connected with the next two. */
export function many(count: number): Record<string, string> {
  const lines = ["application: many", "libraries: [wave]", "components:"];
  for (let i = 1; i <= count; ++i) lines.push(`  F${i}: {model: LowPass}`);
  lines.push("connections:");
  for (let i = 1; i < count; ++i) lines.push(`  - F${i}.Filtered -> F${i + 1}.Raw`);
  return { "many.yaml": `${lines.join("\n")}\n` };
}
