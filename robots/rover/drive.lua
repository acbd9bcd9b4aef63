-- SPDX-License-Identifier: Apache-2.0
-- Drives the rover a curve to the left and lets it come to rest by itself: a speed that is not
-- renewed ends in a smooth stop.

wait(0.1)  -- the wheels have to be measured first
assert(wait(Arming:arm()))
print("armed")
for _ = 1, 40 do
  assert(wait(Chassis.Drive:setVelocity(0.3, 0.4)))
  wait(0.1)
end
print(string.format("drove to x = %.2f m, y = %.2f m", Chassis.Drive.X, Chassis.Drive.Y))
wait(1.5)
print(string.format("rests at x = %.2f m, y = %.2f m", Chassis.Drive.X, Chassis.Drive.Y))
print(string.format("really    x = %.2f m, y = %.2f m", Rover.Place.x - (-1.5), Rover.Place.y))
stop()
