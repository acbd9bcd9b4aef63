-- SPDX-License-Identifier: Apache-2.0
-- Moves the arm into its range, and leaves it to the compensation of its gravity:
--   armature run robots/wam/demo/weightless.yaml --sim --script robots/wam/demo/weightless.lua

while WAM.safety_state ~= "ACTIVATED" do wait(0.1) end
wait(1)
assert(wait(Arming:arm()))
wait(1)
assert(wait(Generator:moveTo(array(0.5, -1.2, 0.3, 2.2, -0.5, 0.4, 0.5), 5)))
wait(2)
assert(wait(Modes:switch("weightless")))
wait(2)   -- what the PIDs drove with dies away, and the arm comes to rest
wait(10)  -- it stays there
Arming:disarm()  -- a controller that drives nothing brings it nowhere, not home either
wait(0.1)
WAM.held_by_hand = true  -- in this demonstration the operator holds it when its torques end
stop()
