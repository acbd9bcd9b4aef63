-- SPDX-License-Identifier: Apache-2.0
-- A tour from home through the range of the arm with 7 joints, each motion in 5 s, with whichever controller it has:
--   armature run robots/wam/demo/computed_torque.yaml --sim --script robots/wam/demo/tour.lua

while WAM.safety_state ~= "ACTIVATED" do wait(0.1) end
wait(1)
assert(wait(Arming:arm()))
wait(1)   -- until then torques grow slowly

for _, positions in ipairs({
  array(0.0, 0.0, 0.0, 1.57, 0.0, 0.0, 0.0),
  array(1.2, 1.0, -0.8, 0.6, -1.5, 0.8, 1.2),
  array(-1.0, -0.9, 0.9, 2.2, 0.6, -0.9, -1.4),
  array(0.0, -1.9, 0.0, 3.0, 0.0, 0.0, 0.0),
}) do
  assert(wait(Generator:moveTo(positions, 5)))
  wait(1)
end
stop()
