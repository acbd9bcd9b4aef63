local m m = machine {
  name = "M", period = 0.02, initial = "A",
  A = {initial = "X", X = {run = function() wait(Axis:moveTo(3)) end, done = "Y"}, Y = {final = true},
       on = {[Axis.Moved] = {{"B", guard = function(x) return x > 2 end}}, go = "B"}, done = "B"},
  B = {during = function() m:send("go") end, after = {0.1, back_to = "A"}, on = {go = print},
       when = {{function() return now() > 0.8 end, "End"}}, failed = "End"},
  End = {final = true, entry = stop},
}
m:start() m:send("go", 1, {}) print(m, m.state, m:is_in("A")) wait(m)
