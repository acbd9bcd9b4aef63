-- SPDX-License-Identifier: Apache-2.0
-- The experiment of paper 1, table 2, on a head that a person or the deployment lets scripts arm:
--   armature run robots/janus/deployments/pid.yaml --sim --script robots/janus/experiment.lua

wait(0.1)   -- the cards answer
assert(wait(Arming:arm()))

local begin = now()
local function after(seconds, positions, time)
  at(begin + seconds, function() assert(wait(Generator:moveTo(positions, time))) end)
end

after(5, array(1.0, 1.0), 10)
after(17, array(2.0, 2.0), 9)
after(28, array(3.0, 1.0), 8)
after(38, array(1.0, 3.0), 7)
after(47, array(4.0, 4.0), 5)
after(54, array(0.0, 0.0), 5)

-- How well the joints follow: looks at what the PIDs see, a hundred times a second.
local period = 0.01
local function either(this, that)   -- table 1 calls them pid1 and pid2
  local found, pid = pcall(this)
  return found and pid or that()
end
local joints = {
  {pid = either(function() return PID1 end, function() return pid1 end), iae = 0, largest = 0},
  {pid = either(function() return PID2 end, function() return pid2 end), iae = 0, largest = 0}}
while now() < begin + 60 do
  wait(period)
  for _, joint in ipairs(joints) do
    joint.last = math.abs(joint.pid.Ref - joint.pid.Sen)
    joint.iae = joint.iae + period * joint.last
    joint.largest = math.max(joint.largest, joint.last)
  end
end
for number, joint in ipairs(joints) do
  print(string.format("joint %d: IAE %.5f rad s, largest error %.5f rad, at the end %.5f rad",
                      number, joint.iae, joint.largest, joint.last))
end
stop()
