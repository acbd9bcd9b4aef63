-- SPDX-License-Identifier: Apache-2.0
-- After an E-stop: the operator has put the arm at home and begun the program again. Nothing moves before it is armed.

while WAM.safety_state ~= "ACTIVATED" do wait(0.1) end
wait(2)
assert(wait(Arming:arm()))
wait(1)
assert(wait(Generator:moveTo(array(0.5, -1.2, 0.3, 2.2, 0.0, 0.4, 0.0), 5)))
wait(1)
stop()
