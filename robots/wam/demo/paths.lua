-- SPDX-License-Identifier: Apache-2.0
-- Draws a square with rounded corners and an arc in the air, and jogs the tool:
--   armature run robots/wam/demo/paths.yaml --sim --script robots/wam/demo/paths.lua

while WAM.safety_state ~= "ACTIVATED" do wait(0.1) end
wait(1)
assert(wait(Arming:arm()))
wait(1)
assert(wait(Generator:moveTo(array(0.2, -1.2, 0.3, 2.2, -0.5, 0.4, 0.5), 5)))

local begin = Planner:pose()
-- Beside where it began, in y and z [m].
local function beside(y, z)
  return begin[1], begin[2] + y, begin[3] + z, begin[4], begin[5], begin[6]
end
local function poses(...)
  local all = {}
  for _, place in ipairs({...}) do
    for _, number in ipairs({beside(place[1], place[2])}) do all[#all + 1] = number end
  end
  return array(table.unpack(all))
end
local function follow(motion)
  while not motion:done() do
    print(string.format("%3.0f %%, %.1f s to go", 100 * motion:progress(), Generator.remaining_time))
    wait(1)
  end
  assert(wait(motion))
end

follow(Planner:movePath(poses({0.15, 0}, {0.15, 0.15}, {0, 0.15}, {0, 0}), 0.03, 0.1))
follow(Planner:moveArc(array(begin[1], begin[2] + 0.1, begin[3] + 0.1), poses({0.2, 0}), 0.1))
follow(Planner:moveLinear(poses({0, 0}), 0))

-- Held on to for half a second, along the tool's own z: each renewal comes within 150 ms.
Planner.jog_frame = "tool"
local before = Planner:pose()
local jog = Planner:jog(3, -0.1)
for _ = 1, 10 do
  assert(Planner:keepJogging(3, -0.1))
  wait(0.05)
end
wait(jog)
local after = Planner:pose()
print(string.format("jogged by %.3f m", math.sqrt((after[1] - before[1])^2 + (after[2] - before[2])^2 + (after[3] - before[3])^2)))

-- Two metres up is no place for this arm: nothing moves, and it says where the path ends.
local moved, why = pcall(function() Planner:moveLinear(poses({0, 2}), 0) end)
assert(not moved)
print(why)
assert(wait(WAM:moveHome()))
wait(0.5)
stop()
