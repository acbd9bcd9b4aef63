// SPDX-License-Identifier: Apache-2.0
#include "armature/cli/check_service.hpp"

#include <map>
#include <utility>

#include <nlohmann/json.hpp>

#include "armature/base/near_name.hpp"
#include "armature/base/quoted.hpp"
#include "armature/cli/libraries.hpp"
#include "armature/deploy/loader.hpp"
#include "armature/inspect/checked_json.hpp"
#include "armature/inspect/model_catalogue.hpp"
#include "armature/platform/file.hpp"

namespace armature::cli {

using Json = nlohmann::ordered_json;

/// What is asked for; what a request does not need is left out.
struct CheckService::Request {
  std::string act;  ///< `check`, `fitting` or `models`
  LoadArguments load;
  std::map<std::string, std::string> texts;  ///< of files that are not saved yet, by their paths
  bool members = true;
  std::string component;
  std::string member;
  bool models = false;
  std::vector<std::string> libraries;

  static base::Result<Request> from(const Json& json);
};

namespace {

const std::vector<std::string> kActs = {"check", "fitting", "models"};

/// Takes the member `key` into `to` if it is given.
template <typename Value>
void take(const Json& from, const char* key, Value& to) {
  if (const auto found = from.find(key); found != from.end()) found->get_to(to);
}

std::string as_text(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string refusal(const Json& id, const std::string& reason) {
  return as_text({{"id", id}, {"error", reason}}) + "\n";
}

/// Files that the editor has changed are read from it, all others from disk.
deploy::FileReader reader_of(const std::map<std::string, std::string>& texts) {
  return [texts](const std::string& path) -> base::Result<std::string> {
    if (const auto changed = texts.find(path); changed != texts.end()) return changed->second;
    return platform::read_file(path);
  };
}

Json json_of(const inspect::End& end) {
  Json json = {
      {"component", end.component}, {"member", end.member}, {"kind", inspect::name_of(end.kind)}};
  if (!end.fits()) json["why_not"] = end.why_not;
  if (end.fits() && !end.names.property.empty()) {
    json["names"] = {{"property", end.names.property}, {"unit", end.names.unit}};
  }
  return json;
}

Json list(const std::vector<inspect::End>& ends) {
  Json all = Json::array();
  for (const inspect::End& end : ends) all.push_back(json_of(end));
  return all;
}

}  // namespace

base::Result<CheckService::Request> CheckService::Request::from(const Json& json) {
  Request request;
  try {
    take(json, "do", request.act);
    take(json, "file", request.load.file);
    take(json, "set", request.load.overrides);
    take(json, "mode", request.load.mode);
    take(json, "texts", request.texts);
    take(json, "members", request.members);
    take(json, "component", request.component);
    take(json, "member", request.member);
    take(json, "models", request.models);
    take(json, "libraries", request.libraries);
  } catch (const Json::exception& problem) {
    return base::Error{std::string("a member of the request has the wrong type: ") +
                       problem.what()};
  }
  return request;
}

CheckService::CheckService(std::vector<std::string> library_folders, Load load)
    : library_folders_(std::move(library_folders)), load_(std::move(load)) {}

CheckService::~CheckService() = default;

std::string CheckService::answer(std::string_view line) {
  const Json json = Json::parse(line, nullptr, false);
  if (!json.is_object()) return refusal(nullptr, "expected a JSON object on one line");
  const Json id = json.value("id", Json());
  const auto request = Request::from(json);
  if (!request) return refusal(id, request.error());
  base::Result<std::string> result = result_of(request.value());
  if (!result) return refusal(id, result.error());
  std::string text = std::move(result.value());
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return R"({"id":)" + as_text(id) + R"(,"result":)" + text + "}\n";
}

base::Result<std::string> CheckService::result_of(const Request& request) {
  if (request.act == "check") return check(request);
  if (request.act == "fitting") return fitting(request);
  if (request.act == "models") return models(request);
  return base::Error{"unknown act " + base::quoted(request.act) +
                     base::suggestion_in_brackets(request.act, kActs)};
}

std::string CheckService::check(const Request& request) {
  LoadArguments arguments = request.load;
  arguments.library_folders = library_folders_;
  const deploy::FileReader read = reader_of(request.texts);
  // What is there may use what its libraries made: it goes first.
  last_.reset();
  last_ = std::make_unique<deploy::Deployment>(load_(arguments, read));
  inspect::CheckedForm form;
  form.members = request.members;
  form.indent = -1;
  form.read = read;
  return inspect::checked_as_json(
      {request.load.file, last_->diagnostics, last_->blueprint, last_->plan}, form);
}

base::Result<std::string> CheckService::fitting(const Request& request) {
  if (last_ == nullptr) return base::Error{"nothing was checked yet: fitting comes after check"};
  const auto ends = inspect::fitting(last_->blueprint, request.component, request.member);
  if (!ends) return base::Error{ends.error()};
  Json json = {{"ends", list(ends.value())}};
  if (request.models) {
    if (const auto names = last_->models.names(); !model_ports_ || names != model_names_) {
      model_ports_ = std::make_unique<inspect::ModelPorts>(last_->models);
      model_names_ = names;
    }
    json["models"] =
        list(model_ports_->fitting(last_->blueprint, request.component, request.member));
  }
  return as_text(json);
}

base::Result<std::string> CheckService::models(const Request& request) const {
  const auto registry = models_of(request.libraries, library_folders_);
  if (!registry.diagnostics.ok()) return base::Error{registry.diagnostics.to_text()};
  return inspect::models_as_json(registry.models, {}, -1);
}

}  // namespace armature::cli
