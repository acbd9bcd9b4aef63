// SPDX-License-Identifier: Apache-2.0
#include "idl/compile.hpp"

#include <filesystem>
#include <utility>
#include <vector>

#include "armature/base/visible_text.hpp"
#include "idl/cpp_backend.hpp"
#include "idl/cpp_name_check.hpp"
#include "idl/cpp_names.hpp"
#include "idl/json_backend.hpp"
#include "idl/output.hpp"
#include "idl/typescript_backend.hpp"

namespace armature::idl {
namespace {

namespace fs = std::filesystem;

/// A path as a rule of make has it.
std::string escaped(const std::string& path) {
  std::string text;
  for (const char c : path) {
    if (c == ' ' || c == '#' || c == '\\') text += '\\';
    if (c == '$') text += '$';
    text += c;
  }
  return text;
}

/// All outputs depend on all files that were read.
std::string rule(const CompileOptions& options, const std::vector<OutputFile>& outputs,
                 const Loaded& loaded) {
  std::string text;
  for (const OutputFile& output : outputs) {
    text += (text.empty() ? "" : " ") +
            escaped((fs::path(options.output_folder) / output.name).string());
  }
  text += ":";
  for (const auto& source : loaded.sources) text += " \\\n  " + escaped(source->file());
  return text + "\n";
}

base::Result<void> write(const CompileOptions& options, std::vector<OutputFile> outputs,
                         const Loaded& loaded) {
  if (options.depends.empty()) return write_files(options.output_folder, outputs);
  // Written with the others, all or none; an absolute path stays as it is behind their folder.
  outputs.push_back({fs::absolute(options.depends).string(), rule(options, outputs, loaded)});
  return write_files(options.output_folder, outputs);
}

}  // namespace

std::string compile(const CompileOptions& options, const ReadFile& read) {
  Loaded loaded = load(options.file, read);
  if (!loaded.ok()) return loaded.findings();
  const CppNames names(loaded.program, options.name_space);
  check_cpp_names(loaded.program, names, loaded.diagnostics);
  if (!loaded.ok()) return loaded.findings();
  std::vector<OutputFile> outputs = write_cpp(loaded.program, names);
  if (options.json) outputs.push_back(write_json(loaded.program, names));
  if (options.typescript) {
    outputs.push_back(write_typescript(loaded.program));
    outputs.push_back(write_typescript_services(loaded.program));
  }
  const base::Result<void> written = write(options, std::move(outputs), loaded);
  return written ? "" : "rcidl: error: " + base::visible_text(written.error()) + "\n";
}

}  // namespace armature::idl
