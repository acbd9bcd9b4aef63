// SPDX-License-Identifier: Apache-2.0
#include "armature/websocket/internal/pages.hpp"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

namespace armature::websocket::internal {
namespace {

namespace fs = std::filesystem;

constexpr std::pair<std::string_view, std::string_view> kTypes[] = {
    {".css", "text/css; charset=utf-8"},
    {".gif", "image/gif"},
    {".glb", "model/gltf-binary"},
    {".html", "text/html; charset=utf-8"},
    {".ico", "image/x-icon"},
    {".jpg", "image/jpeg"},
    {".js", "text/javascript; charset=utf-8"},
    {".json", "application/json"},
    {".map", "application/json"},
    {".mjs", "text/javascript; charset=utf-8"},
    {".png", "image/png"},
    {".stl", "model/stl"},
    {".svg", "image/svg+xml"},
    {".txt", "text/plain; charset=utf-8"},
    {".urdf", "application/xml"},
    {".webp", "image/webp"},
    {".woff2", "font/woff2"},
};

/// Printable, and no part of it is hidden or leads upwards.
bool is_plain(std::string_view path) {
  const bool printable = std::ranges::all_of(path, [](char c) { return c > ' ' && c < 0x7f; });
  return printable && path.starts_with('/') && path.find("/.") == std::string_view::npos &&
         path.find('\\') == std::string_view::npos && path.find("//") == std::string_view::npos;
}

}  // namespace

base::Result<Pages> Pages::in(const std::string& folder) {
  std::error_code problem;
  const fs::path real = fs::canonical(folder, problem);
  if (problem) {
    return base::Error{"the folder of pages '" + folder + "' cannot be read: " + problem.message()};
  }
  if (!fs::is_directory(real, problem)) {
    return base::Error{"the folder of pages '" + folder + "' is a file"};
  }
  if (!fs::is_regular_file(real / "index.html", problem)) {
    return base::Error{"the folder of pages '" + folder + "' has no index.html"};
  }
  return Pages(real.string());
}

std::optional<Page> Pages::find(std::string_view path) const {
  if (!is_plain(path)) return std::nullopt;
  std::error_code problem;
  fs::path file = fs::path(folder_) / path.substr(1);
  if (fs::is_directory(file, problem)) file /= "index.html";
  file = fs::canonical(file, problem);  // where links lead to
  const bool inside = !problem && file.string().starts_with(folder_ + "/");
  if (!inside || !fs::is_regular_file(file, problem)) return std::nullopt;
  const std::string extension = file.extension().string();
  const auto type = std::ranges::find(kTypes, extension, [](const auto& one) { return one.first; });
  if (type == std::end(kTypes)) return std::nullopt;
  return Page{file.string(), std::string(type->second)};
}

}  // namespace armature::websocket::internal
