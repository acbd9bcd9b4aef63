-- SPDX-License-Identifier: Apache-2.0
-- Somebody presses E-stop in the middle of a motion. The arm sinks slowly, braked by its motors; the application says what
-- has happened and what to do, and leaves what led to it in a black box.

while WAM.safety_state ~= "ACTIVATED" do wait(0.1) end
assert(wait(Arming:arm()))
wait(1)
Generator:moveTo(array(0.8, -0.5, 0.5, 1.5, 0.0, 0.5, 0.0), 5)
wait(2.5)
wait(WAM:estop())
wait(3)
stop()
