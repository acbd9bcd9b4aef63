local ok, why = pcall(machine, {A = {on = {go = "C", [5] = 6, done = {}}, after = {1}, when = 3, x = 1}, B = 5, 7})
at(0.5, function() while true do pcall(error, {}) end end)
machine {A = {entry = function() error({}) end}}:start()
