-- SPDX-License-Identifier: Apache-2.0
-- The experiment of paper 2, section 6: from the initial position a new position is commanded to both joints.
--   armature run robots/janus/demo/paper2.yaml --sim --script robots/janus/paper2.lua --out build/demo/paper2
--
-- The paper does not print the excursion. Its ITAE / IAE of joint 1, 1.27 s, is the middle of the error's time: a motion of
-- 2.5 s. Here it goes through the largest excursion that the head allows in that time.
local target, duration = array(4.0, 4.0), 2.5

wait(0.1)   -- the cards answer
assert(wait(Arming:arm()))
wait(2)     -- for a second after arming the voltage grows slowly

local begin = now()
local motion = Generator:moveTo(target, duration)

-- The integrals of paper 2, table 2, over the time of the motion, of what the PIDs see.
local period = 0.01
local joints = {{pid = PID1}, {pid = PID2}}
for _, joint in ipairs(joints) do joint.iae, joint.itae, joint.ise, joint.itse = 0, 0, 0, 0 end
while now() < begin + duration do
  wait(period)
  local t = now() - begin
  for _, joint in ipairs(joints) do
    local e = math.abs(joint.pid.Ref - joint.pid.Sen)
    joint.iae = joint.iae + period * e
    joint.itae = joint.itae + period * t * e
    joint.ise = joint.ise + period * e * e
    joint.itse = joint.itse + period * t * e * e
  end
end
assert(wait(motion))
for number, joint in ipairs(joints) do
  print(string.format("joint %d: IAE %.4f  ITAE %.4f  ISE %.2e  ITSE %.2e", number, joint.iae, joint.itae, joint.ise,
                      joint.itse))
end
print("paper 2, joint 1: IAE 0.0213  ITAE 0.0271  ISE 1.20e-03  ITSE 1.40e-03")
stop()
