// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace armature::cli {

struct CommandLine;

// The commands of the program; `add_NAME` is in NAME_command.cpp.
void add_run(const CommandLine& to);
void add_browse(const CommandLine& to);
void add_check(const CommandLine& to);
void add_graph(const CommandLine& to);
void add_models(const CommandLine& to);
void add_report(const CommandLine& to);
void add_replay(const CommandLine& to);
void add_convert(const CommandLine& to);
void add_edit(const CommandLine& to);
void add_bundle(const CommandLine& to);
void add_generate(const CommandLine& to);
void add_studio(const CommandLine& to);
void add_new(const CommandLine& to);
void add_complete(const CommandLine& to);

/// In the order of the help.
inline constexpr void (*kCommands[])(const CommandLine& to) = {
    add_run,     add_browse, add_check,  add_graph,    add_models, add_report, add_replay,
    add_convert, add_edit,   add_bundle, add_generate, add_studio, add_new,    add_complete};

}  // namespace armature::cli
