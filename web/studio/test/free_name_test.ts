// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import { free_name } from "../src/free_name.ts";

test("a component has its model's name if that is free", () => assert.equal(free_name("PID", ["Joint"]), "PID"));
test("else the first free number", () => assert.equal(free_name("PID", ["PID", "PID2", "PID4"]), "PID3"));
test("a name has letters, digits and underscores alone", () => assert.equal(free_name("ns::Joint", []), "nsJoint"));
