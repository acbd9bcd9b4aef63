-- SPDX-License-Identifier: Apache-2.0
-- Arms the robot, which is simulated; then topics of ROS 2 move it.
wait(0.5)  -- the joints have to be measured first
assert(wait(Arming:arm()))
print("armed")
