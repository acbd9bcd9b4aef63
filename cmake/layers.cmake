# SPDX-License-Identifier: Apache-2.0
# Who may use whom, as ARCHITECTURE.md has it: a library, a colon, the libraries it may use. Everything may
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
    "record: base exec types platform"
    "document: base exec component types"
    "orocos: base document"
    "analysis: base document exec component platform"
    "inspect: base exec component types platform"
    "deploy: base document orocos analysis inspect exec component platform"
    "report: base platform control component exec record"
    "remote: base idl ride document inspect exec component rt types platform"
    "lua: base inspect exec component rt types platform"
    "browser: base remote ride lua inspect exec component platform"
    "controllers: base component control guardian types"
    "general: base component record rt"
    "sim: base control"
    "robots: base platform rt types controllers component can control guardian sim"
    "cli: base platform types rt control component can ride tls exec record document orocos analysis inspect deploy report lua remote browser controllers general sim"
    "testing: base platform types rt guard control component can guardian ride tls exec record document orocos analysis inspect deploy report lua remote browser controllers general sim")
