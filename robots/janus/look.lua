-- SPDX-License-Identifier: Apache-2.0
-- The head looks to one side and back; see deployments/operator.yaml.

assert(wait(Arming:arm()))
print("armed")
assert(wait(Generator:moveTo(array(0.4, 0.2), 1)))
print("looks to the side")
assert(wait(Generator:moveTo(array(0.0, 0.0), 1)))
print("and ahead")
local begun, refusal = pcall(function() return assert(wait(Generator:moveTo(array(9.0, 0.0), 1))) end)
assert(not begun)
print("too far: " .. refusal)
stop()
