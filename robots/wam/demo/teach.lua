-- SPDX-License-Identifier: Apache-2.0
-- Teaches the arm a motion and a pose, and plays it at three speeds:
--   armature run robots/wam/demo/teach.yaml --sim --script robots/wam/demo/teach.lua
-- Nobody takes an emulated arm by the hand: here the arm moves itself while the Teacher listens. With a real
-- arm you switch to the mode "weightless" first, lead it, and switch back to "npid".

while WAM.safety_state ~= "ACTIVATED" do wait(0.1) end
wait(1)
assert(wait(Arming:arm()))
wait(1)
assert(wait(Generator:moveTo(array(0.5, -1.2, 0.3, 2.2, -0.5, 0.4, 0.5), 5)))
assert(wait(Teacher:keepPose("begin")))

local recording = Teacher:record("wave")
wait(0.2)
assert(wait(Generator:moveTo(array(0.8, -1.0, 0.2, 1.9, -0.3, 0.2, 0.2), 3)))
assert(wait(Generator:moveTo(array(0.3, -1.1, 0.4, 2.3, -0.6, 0.5, 0.7), 3)))
assert(wait(Teacher:finish()))
assert(wait(recording))

assert(wait(Modes:switch("weightless")))   -- a hand may lead it now
wait(1)
assert(wait(Modes:switch("npid")))         -- it stays where the hand has left it
wait(1)

for _, speed in ipairs({1.0, 0.5, 2.0}) do
  assert(wait(Teacher:goTo("begin", 0)))
  local motion = Teacher:play("wave", speed)
  while not motion:done() do
    print(string.format("speed %.1f: %3.0f %%, %.1f s to go", speed, 100 * motion:progress(), Generator.remaining_time))
    wait(1)
  end
  assert(wait(motion))
end
print(Teacher:list())
assert(wait(WAM:moveHome()))
wait(0.5)
stop()
