-- SPDX-License-Identifier: Apache-2.0
-- Two joints in rad, and the rail in m.
local function reach(target, seconds)
  assert(wait(Generator:moveTo(target, seconds)))
  wait(0.5)
  for number, joint in ipairs({Joint1, Joint2, Joint3}) do
    local unit = number == 3 and "mm" or "mrad"
    print(string.format("axis %d: %.1f %s from its target", number, 1000 * math.abs(joint.Position - target[number]), unit))
  end
end

wait(0.1)
assert(wait(Arming:arm()))
reach(array(0.5, -1.0, 1.2), 3)
reach(array(0.0, 0.0, 0.0), 3)
stop()
