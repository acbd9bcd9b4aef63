-- SPDX-License-Identifier: Apache-2.0
-- The head moves with the old controller; then, if its shadow was near enough, it moves with the new one.
wait(0.1)
assert(wait(Arming:arm()))
Deviations:reset()  -- before, nobody drove
assert(wait(Generator:moveTo(array(0.5, 0.5), 2)))
print(string.format("the shadow was at most %.3f V from what drove", Deviations.Largest))
-- It sees the errors of the one that drives, which its own commands do not make smaller: its integral grows on. Look at the curve, too.
assert(wait(Modes:switch("feed_forward")))
assert(wait(Generator:moveTo(array(0.0, 0.0), 2)))
print("moved with the new controller")
stop()
