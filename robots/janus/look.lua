-- SPDX-License-Identifier: Apache-2.0
-- The head looks to one side and back; see deployments/operator.yaml.

-- The robot may have begun a moment ago: its cards have to answer first.
local armed, why
for _ = 1, 50 do
  armed, why = wait(Arming:arm())
  if armed then break end
  wait(0.1)
end
assert(armed, why)
print("armed")
assert(wait(Generator:moveTo(array(0.4, 0.2), 1)))
print("looks to the side")
assert(wait(Generator:moveTo(array(0.0, 0.0), 1)))
print("and ahead")
local begun, refusal = pcall(function() return assert(wait(Generator:moveTo(array(9.0, 0.0), 1))) end)
assert(not begun)
print("too far: " .. refusal)
stop()
