// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import { end_text, has_failed } from "../src/run_end.ts";
import { acts_of, reason_text } from "../src/states.ts";

test("how a run has ended is told in words", () => {
  assert.equal(end_text(0), "ended");
  assert.equal(end_text(-1), "ended", "nobody knows how");
  assert.equal(end_text(1), "failed");
  assert.equal(end_text(4), "ended by a safety reaction");
  assert.equal(end_text(128 + 11), "crashed: segmentation fault");
  assert.equal(end_text(128 + 9), "was killed");
  assert.equal(end_text(77), "ended with code 77");
});

test("only what has ended otherwise than well has failed", () => {
  assert.equal(has_failed("ended", 0), false);
  assert.equal(has_failed("ended", -1), false);
  assert.equal(has_failed("ended", 139), true);
  assert.equal(has_failed("running", 1), false, "the code of an earlier run");
});

test("a component is offered what its state allows", () => {
  assert.deepEqual(acts_of("Running"), ["stop"]);
  assert.deepEqual(acts_of("Stopped"), ["start"]);
  assert.deepEqual(acts_of("PreOperational"), ["start"]);
  assert.deepEqual(acts_of("RunTimeError"), ["recover", "stop"]);
  assert.deepEqual(acts_of("Exception"), ["reset"]);
  assert.deepEqual(acts_of(""), [], "nothing runs");
});

test("a reason does not repeat the state", () => {
  assert.equal(reason_text("Exception", "exception: the lens is dirty"), "the lens is dirty");
  assert.equal(reason_text("Stopped", "input 'In': no data"), "input 'In': no data");
});
