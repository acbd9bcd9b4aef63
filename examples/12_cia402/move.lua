-- SPDX-License-Identifier: Apache-2.0
local function reach(target, seconds)
  assert(wait(Generator:moveTo(target, seconds)))
  wait(0.5)
  for number, joint in ipairs({Joint1, Joint2}) do
    print(string.format("joint %d: %.1f mrad from its target", number, 1000 * math.abs(joint.Position - target[number])))
  end
end

wait(0.1)
assert(wait(Arming:arm()))
reach(array(0.5, -1.0), 2)
reach(array(0.0, 0.0), 2)
stop()
