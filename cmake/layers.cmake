# SPDX-License-Identifier: Apache-2.0
# Who may use whom, as ARCHITECTURE.md has it: "library: the libraries it may use". Everything may
# use base, only tests may use testing. Read by ArmatureLibrary.cmake (what a library declares) and
# by check_layers.py (what its files include).
set(ARMATURE_LAYERS
    "base:"
    "platform: base"
    "types: base"
    "rt: base platform"
    "control: base"
    "guard: base platform rt"
    "idl: base"
    "component: base rt types"
    "can: base platform rt"
    "guardian: base platform can"
    "ride: base platform rt types"
    "tls: base platform ride"
    "exec: base component rt types platform"
    "record: base exec component types rt platform"
    "deploy: base exec component types platform"
    "report: base platform types control component exec record"
    "remote: base ride deploy exec component rt types platform"
    "lua: base exec component rt types platform"
    "browser: base remote ride lua exec component types platform"
    "library: base component can control guardian record rt types"
    "sim: base exec component can control"
    "robots: base platform rt types library component can control guardian sim"
    "studio: base remote record"
    "cli: base platform types rt control component can ride tls exec record deploy report lua remote browser library sim studio"
    "testing: base platform types rt guard control component can guardian ride tls exec record deploy report lua remote browser library sim studio")
