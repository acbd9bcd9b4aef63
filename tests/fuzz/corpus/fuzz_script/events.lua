local s s = on(Axis.Moved, function(x, y) print(x, y[1]) if x > 2 then s:cancel() end wait(0.1) end)
Axis:moveTo(5) print(wait(Axis.Moved, 0.1)) Axis.Gain = 2
