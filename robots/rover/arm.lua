-- SPDX-License-Identifier: Apache-2.0
-- Arms the simulated rover, beside which nobody stands.
wait(0.1)  -- the wheels have to be measured first
assert(wait(Arming:arm()))
print("armed")
