-- SPDX-License-Identifier: Apache-2.0
-- The arm with 7 joints through a sequence of motions with two controllers, which take turns in motion:
--   armature run robots/wam/demo/two_controllers.yaml --sim --script robots/wam/demo/sequence.lua
-- Before it stops it goes home, as arm7.yaml has it.

while WAM.safety_state ~= "ACTIVATED" do wait(0.1) end
wait(1)   -- it holds itself
assert(wait(Arming:arm()))
wait(1)   -- until then torques grow slowly

local function move(positions)
  local moving = Generator:moveTo(positions, 5)
  return function() assert(wait(moving)) wait(1) end
end

move(array(0.5, -1.2, 0.3, 2.2, -0.5, 0.4, 0.5))()

local arrive = move(array(-0.6, -0.6, -0.4, 1.6, 0.6, -0.5, -1.0))
wait(2)
assert(wait(Modes:switch("computed_torque")))
arrive()

move(array(0.8, 0.4, 0.5, 1.2, -1.0, 0.8, 1.5))()

arrive = move(array(0.0, -1.5, 0.0, 2.4, 0.0, 0.0, 0.0))
wait(2)
assert(wait(Modes:switch("npid")))
arrive()
stop()
