-- SPDX-License-Identifier: Apache-2.0
-- The head looks around until it is called home; whoever says Arming:stop() makes it pause.
--   armature run robots/janus/deployments/pid.yaml --sim --script robots/janus/patrol.lua

local places = {array(1.0, 0.5), array(3.0, 1.0), array(9.0, 1.0)}   -- the third is out of reach
local at_place = 1

local function say(text) print(string.format("%6.2f s  %s", now(), text)) end

local function look()
  assert(wait(Generator:moveTo(places[at_place], 3)))
  say(string.format("looks at place %d, joints at %.2f and %.2f", at_place, PID1.Sen, PID2.Sen))
  at_place = at_place % #places + 1
end

local function forget_place(why)
  say("leaves out place " .. at_place .. ": " .. why)
  table.remove(places, at_place)
  at_place = 1
end

local patrol = machine {
  name = "Patrol", initial = "Waking",
  Waking = {
    run = function() wait(0.1) assert(wait(Arming:arm())) end,   -- the cards answer, then
    done = "Looking", failed = "Off",
  },
  Looking = {
    initial = "Moving",
    on = {[Arming.Stop] = "Paused", [Arming.Disarm] = "Off", home = "Returning"},
    failed = {"Looking", action = forget_place},
    Moving = {run = look, done = "Watching"},
    Watching = {after = {1.0, "Moving"}},
  },
  Paused = {
    entry = function() say("pauses") end,
    exit = function() say("goes on") end,
    on = {[Arming.Disarm] = "Off", home = "Returning"},
    after = {2.0, "Looking"},
  },
  Returning = {
    run = function() assert(wait(Generator:moveTo(array(0.0, 0.0), 5))) end,
    done = "Off", failed = "Off",
  },
  Off = {final = true, entry = function() say("is off") end},
}

patrol:start()
at(15, function() Arming:stop() end)
at(30, function() patrol:send("home") end)
wait(patrol)
stop()
