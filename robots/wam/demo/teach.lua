-- SPDX-License-Identifier: Apache-2.0
-- Teaches the arm a motion and a pose, and plays it at three speeds:
--   armature run robots/wam/demo/teach.yaml --sim --script robots/wam/demo/teach.lua
-- WAM:leadByHand stands for the hand that leads a real arm.

while WAM.safety_state ~= "ACTIVATED" do wait(0.1) end
wait(1)
assert(wait(Arming:arm()))
wait(1)
assert(wait(Generator:moveTo(array(0.5, -1.2, 0.3, 2.2, -0.5, 0.4, 0.5), 5)))
assert(wait(Teacher:keepPose("begin")))

assert(wait(Modes:switch("weightless")))
wait(1)
local recording = Teacher:record("wave")
wait(0.2)
for i = 0, 299 do  -- shoulder, elbow and wrist, in a swing of 3 s
  local swing = 0.3 * math.sin(2 * math.pi * i / 300)
  assert(WAM:leadByHand(array(swing, 0.5 * swing, 0, -swing, 0, swing, 0)))
  wait(0.01)
end
wait(0.3)
assert(wait(Teacher:finish()))
assert(wait(recording))
assert(wait(Modes:switch("npid")))  -- it stays where the hand has left it
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
