-- SPDX-License-Identifier: Apache-2.0
wait(0.1)
for number, joint in ipairs({Joint1, Joint2}) do
  assert(wait(joint:home()))
  print(string.format("joint %d is at home, at %.2f rad", number, joint.Position))
end
assert(wait(Arming:arm()))
assert(wait(Generator:moveTo(array(0.0, 0.5), 4)))
wait(0.5)
print(string.format("and then at %.2f and %.2f rad", Joint1.Position, Joint2.Position))
print(string.format("really at %.2f and %.2f rad", Drive1.angle, Drive2.angle))
stop()
