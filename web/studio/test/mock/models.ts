// SPDX-License-Identifier: Apache-2.0
// A few models, as `armature models --json` has them.
import type { Model, Operation, Port, Property } from "../../src/checked.ts";

const property = (name: string, type: string, value: string, doc: string, more: Partial<Property> = {}): Property => ({
  name, type, unit: "", doc, default: value, persistent: true, mandatory: false, changeable_while_running: true, ...more,
});
const port = (name: string, doc: string, unit = "", type = "double", more: Partial<Port> = {}): Port => ({ name, type, unit, doc, ...more });
const operation = (name: string, doc: string, args: [string, string][] = [], command = false): Operation => ({
  name, doc, command, by_operator: false, result: "", signature: `void(${args.map(([type, what]) => `${type} ${what}`).join(", ")})`,
  arguments: args.map(([type, what]) => ({ name: what, type })),
});
const event = (name: string, doc: string) => ({ name, doc, signature: "void()", arguments: [] });

function model(name: string, library: string, doc: string, members: Partial<Model>): Model {
  return { name, library, doc, granularity: "algorithm", face: kFaces.has(name) ? name.toLowerCase() : "", properties: [], inputs: [], outputs: [], port_arrays: [], operations: [], events: [], requirements: [], ...members };
}

const kFaces = new Set(["Button", "Switch", "Slider", "Light", "Number", "Text", "Plot"]);

const unit = property("Unit", "string", "", "of the number and of all bounds");
const numbered = (name: string, count: number, doc: string, of_unit: string): Port[] =>
  Array.from({ length: count }, (_, i) => port(`${name}${i + 1}`, doc, of_unit));

export const kModels: Model[] = [
  model("Source", "wave", "a wave", {
    properties: [
      property("Frequency", "double", "1", "of the wave", { unit: "Hz", range: [0, 50] }),
      property("Amplitude", "double", "0.5", "half of the wave's height", { unit: "rad", range: [0, 3.14159] }),
    ],
    outputs: [port("Position", "where the wave is", "rad")],
  }),
  model("LowPass", "wave", "smooths what it reads", {
    properties: [property("Weight", "double", "0.1", "of a new value", { range: [0, 1] })],
    inputs: [port("Raw", "what is smoothed", "rad", "double", { triggers: true })], outputs: [port("Filtered", "smoothed", "rad")],
  }),
  model("Watcher", "wave", "logs what it sees", { inputs: [port("Value", "what is looked at", "rad")] }),
  model("Joint", "robot", "a joint of the robot with its limiter", {
    properties: [
      property("PositionMin", "double", "", "least position", { unit: "rad", mandatory: true }),
      property("PositionMax", "double", "", "greatest position", { unit: "rad", mandatory: true }),
      property("MaxVelocity", "double", "3", "the limiter lets pass", { unit: "rad/s", range: [0, null] }),
      property("GearRatio", "double", "1", "turns of the motor for one of the joint"),
      property("Brake", "bool", "false", "the joint has a brake", { values: ["false", "true"] }),
    ],
    inputs: [port("Voltage", "that is to be applied", "V")],
    outputs: [port("Position", "measured", "rad"), port("Velocity", "measured", "rad/s"), port("Armed", "whether it may move", "", "bool")],
    operations: [operation("brakeApply", "applies the brake"), operation("moveTo", "goes to a position", [["double", "target [rad]"]], true)],
    events: [event("Limited", "the limiter changed a command")],
    requirements: [{ name: "sensorRead", kind: "operation", signature: "double()", doc: "reads the encoder", optional: true }],
  }),
  model("PID", "robot", "controls a joint", {
    properties: [property("Kp", "double", "100", "gain", { range: [0, 1000] }), property("Ki", "double", "0", "integral gain", { range: [0, 200] })],
    inputs: [port("Ref", "wanted position", "rad"), port("Sen", "measured position", "rad")], outputs: [port("Out", "voltage", "V")],
  }),
  model("Sensor", "robot", "collects the joints' positions", {
    properties: [property("joints", "int", "7", "how many joints there are", { range: [1, 64] })],
    inputs: numbered("Position", 7, "of a joint", "rad"), port_arrays: [{ name: "Position", count: "joints" }],
    outputs: [port("sensor", "all positions", "rad", "vector<double>", { size: 7 })],
  }),
  model("Robot", "robot", "what a robot weighs", {
    properties: [property("robot_description", "text", "", "the robot's description (URDF), a file")],
  }),
  model("Generator", "robot", "moves the axes from point to point", {
    properties: [property("max_vel", "vector<double>", "[1]", "greatest velocity of each axis", { unit: "rad/s" })],
    inputs: [port("sensor", "measured", "rad", "vector<double>", { size: 7 })], outputs: numbered("Ref", 7, "wanted position of an axis", "rad"),
    port_arrays: [{ name: "Ref", count: "num_axes" }],
    operations: [operation("moveTo", "goes to a position", [["vector<double>", "target [rad]"], ["double", "time [s]"]], true), operation("hold", "stays", [], true)],
    events: [event("Arrived", "the last motion has ended")],
  }),
  model("AxesGenerator", "robot", "moves axes from point to point, and one at a time", {
    properties: [property("num_axes", "int", "2", "how many axes there are"), property("max_vel", "vector<double>", "[1, 2]", "greatest velocity of each axis", { unit: "rad/s" })],
    outputs: [port("nAxesDesiredPosition", "desired", "rad", "vector<double>", { size: 2 })],
    operations: [
      operation("moveTo", "goes to a position", [["vector<double>", "target [rad]"], ["double", "time [s]"]], true),
      operation("jog", "moves an axis while it is held", [["int", "axis, from 1"], ["double", "velocity [rad/s]"]], true),
      operation("keepJogging", "goes on with it", [["int", "axis, from 1"], ["double", "velocity [rad/s]"]]),
    ],
  }),
  model("PathPlanner", "robot", "moves a tool on paths", {
    properties: [
      property("max_tool_velocity", "double", "0.25", "of the tool", { unit: "m/s" }), property("max_tool_turning", "double", "1", "of the tool", { unit: "rad/s" }),
      property("jog_frame", "text", "base", "in whose axes jog moves: base or tool"),
    ],
    operations: [
      operation("jog", "moves the tool while it is held", [["int", "axis, from 1"], ["double", "velocity"]], true),
      operation("keepJogging", "goes on with it", [["int", "axis, from 1"], ["double", "velocity"]]),
    ],
  }),
  model("Hardware", "robot", "drives the robot", {
    properties: [property("at_home", "bool", "false", "the operator has put the arm at home", { by_operator: true })],
  }),
  model("Arming", "robot", "lets the robot move, by its operator", {
    operations: [{ ...operation("arm", "lets the joints move from now on", [], true), by_operator: true }, operation("disarm", "effort 0, brakes applied")],
  }),
  model("Sequence", "controls", "does calls one after the other", { granularity: "application", most_calls: 100, operations: [operation("run", "does them", [], true)], events: [event("Done", "all are done")] }),
  model("Request", "controls", "asks an operation and writes its result", { most_calls: 1, operations: [operation("ask", "asks once")], outputs: [port("Result", "the last answer")] }),
  model("Camera", "vision", "sees", {
    operations: [
      operation("initialize", "gets ready"), operation("setThreshold", "of what is bright", [["int", "low"], ["double", "far [m]"]]),
      operation("start", "begins to look", [], true), { ...operation("arm", "only the operator does that", [], true), by_operator: true },
    ],
  }),
  model("Button", "controls", "something to press", { operations: [operation("press", "as a finger does")], events: [event("Pressed", "somebody pressed it")] }),
  model("Switch", "controls", "something to turn on and off", {
    properties: [property("Initially", "bool", "false", "whether it is on at the start")], outputs: [port("On", "whether it is on", "", "bool")],
    operations: [operation("turn", "on or off", [["bool", "on"]])], events: [event("TurnedOn", "it was off before")],
  }),
  model("Slider", "controls", "a number that somebody moves", {
    properties: [
      property("Low", "double", "0", "the least number"), property("High", "double", "1", "the greatest number"),
      property("Hold", "bool", "false", "whether it goes back when it is let go of"), unit,
    ],
    outputs: [port("Out", "where it is")], operations: [operation("move", "moves it", [["double", "value"]], true)],
  }),
  model("Light", "controls", "shines while it reads true", { inputs: [port("On", "whether it shines", "", "bool")] }),
  model("Number", "controls", "shows a number", { properties: [unit], inputs: [port("Value", "what is shown")] }),
  model("Text", "controls", "shows a text", { inputs: [port("Text", "what is shown", "", "text<127>")] }),
  model("Mixer", "chassis", "wheel speeds of a motion", {
    properties: [property("Track", "double", "0.3", "from wheel to wheel", { unit: "m" })],
    inputs: [port("Forward", "speed", "m/s"), port("Turn", "rate", "rad/s")], outputs: [port("Left", "speed", "m/s"), port("Right", "speed", "m/s")],
  }),
  model("Wheel", "chassis", "a wheel", {
    properties: [property("Radius", "double", "0.1", "of the wheel", { unit: "m", range: [0.01, 1] })],
    inputs: [port("Speed", "at the rim", "m/s")], outputs: [port("Angle", "turned", "rad")],
  }),
  model("Driver", "chassis", "drives a quarter of a circle", {
    inputs: [port("Left", "angle", "rad"), port("Right", "angle", "rad")], outputs: [port("Forward", "speed", "m/s"), port("Turn", "rate", "rad/s")],
  }),
];
