// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "idl/compile.hpp"

namespace {

enum ExitCode { kDone = 0, kFailed = 1, kWrongUse = 2 };

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("rcidl: C++ placeholders and services from interface definitions", "rcidl");
  app.set_version_flag("--version", "rcidl " ARMATURE_VERSION);
  armature::idl::CompileOptions options;
  app.add_option("file", options.file, "the interface definition, NAME.idl")->required();
  app.add_option("--out", options.output_folder,
                 "folder for the generated files; created if it is missing")
      ->type_name("FOLDER")
      ->required();
  std::string name_space;
  const CLI::Option* const has_name_space =
      app.add_option("--namespace", name_space,
                     "namespace of the generated C++, also of imported files; default: the name of "
                     "each file")
          ->type_name("NAME");
  app.add_flag("--json", options.json, "also writes the interface as NAME.json");
  app.add_flag("--typescript", options.typescript,
               "also writes NAME.ts, placeholders for pages and Node.js");
  app.add_option("--depends", options.depends,
                 "writes a list of the files that were read, for ninja and make")
      ->type_name("FILE");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const bool asked_for_help = error.get_exit_code() == 0;
    app.exit(error);
    return asked_for_help ? kDone : kWrongUse;
  }
  if (has_name_space->count() > 0) options.name_space = name_space;
  const std::string findings = armature::idl::compile(options);
  std::fputs(findings.c_str(), stderr);
  return findings.empty() ? kDone : kFailed;
}
