// SPDX-License-Identifier: Apache-2.0
// Whatever stands in interface definitions, rcidl answers in time: with findings that have places,
// or with text that is the same twice.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "idl/cpp_backend.hpp"
#include "idl/cpp_name_check.hpp"
#include "idl/cpp_names.hpp"
#include "idl/json_backend.hpp"
#include "idl/load.hpp"

namespace {

using namespace armature;

[[noreturn]] void fail(const std::string& why) {
  std::fprintf(stderr, "%s\n", why.c_str());
  std::abort();
}

/// The bytes are the file, and what it imports is a part of them: behind each form feed begins the
/// next of `b.idl`, `c.idl`, ...
base::Result<std::string> part(std::string_view bytes, const std::string& path) {
  std::size_t index = path.size() == 5 && path.ends_with(".idl")
                          ? static_cast<std::size_t>(path.front() - 'a')
                          : std::size_t{26};
  if (index >= 26) return base::Error{"file '" + path + "' does not exist"};
  for (; index > 0; --index) {
    const std::size_t end = bytes.find('\f');
    if (end == std::string_view::npos) return base::Error{"file '" + path + "' does not exist"};
    bytes.remove_prefix(end + 1);
  }
  return std::string(bytes.substr(0, bytes.find('\f')));
}

std::string written(const idl::Program& program, const idl::CppNames& names) {
  std::string text = idl::write_json(program, names).content;
  for (const idl::OutputFile& file : idl::write_cpp(program, names)) text += file.content;
  return text;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  idl::Loaded loaded =
      idl::load("a.idl", [&](const std::string& path) { return part(bytes, path); });
  const idl::CppNames names(loaded.program, "");
  if (loaded.ok()) idl::check_cpp_names(loaded.program, names, loaded.diagnostics);
  if (!loaded.ok()) {
    if (loaded.findings().empty()) fail("it was refused without a word");
    return 0;
  }
  if (written(loaded.program, names) != written(loaded.program, names)) fail("it was not the same");
  return 0;
}
