local m m = machine {A = {exit = function() m:start() end, entry = function() m:stop() end, on = {go = "A"}}} m:start() m:send("go") m:start()
