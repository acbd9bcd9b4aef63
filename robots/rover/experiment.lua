-- SPDX-License-Identifier: Apache-2.0
-- The ball-tracking experiment, 120 s: the ball rests, rolls a line with a stop, a circle and an eight at 0.3 m/s, behind the screen, and is
-- carried out of sight.
--   armature run --sim --script robots/rover/experiment.lua robots/rover/deployments/rover.yaml

-- What is recorded says which phase it is, where the deployment has somebody to say it.
local told = pcall(function() return Phase.Value end)
local function phase(number, name)
  print(string.format("%6.1f s  %s", now(), name))
  if told then Phase.Value = number end
end

wait(0.1)  -- the wheels have to be measured first
assert(wait(Arming:arm()))

local function after(seconds, number, name, act)
  at(seconds, function() phase(number, name); act() end)
end

phase(1, "rest")
after(3, 2, "a step: a hand turns the rover by 28 degrees", function()
  Rover:put(Rover.Place.x, Rover.Place.y, Rover.Place.heading + math.rad(28))
end)
after(6, 3, "line, with a stop", function() Ball:go("line") end)
after(16, 4, "circle", function() Ball:go("circle") end)
after(46, 5, "eight", function() Ball:go("eight") end)
after(82, 6, "behind the screen", function() Ball:go("hide") end)
after(100, 7, "carried out of sight", function() Ball:go("carry") end)
wait(120 - now())
stop()
