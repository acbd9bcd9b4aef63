-- SPDX-License-Identifier: Apache-2.0
wait(0.1)
assert(wait(Arming:arm()))
assert(wait(Generator:moveTo(array(0.5, -0.5, 1.0), 2)))
assert(wait(Generator:moveTo(array(0.0, 0.0, 0.0), 2)))
wait(0.5)
for number, joint in ipairs({Joint1, Joint2, Joint3}) do
  print(string.format("joint %d is at %.4f rad", number, joint.Position))
end
stop()
