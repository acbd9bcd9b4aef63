// SPDX-License-Identifier: Apache-2.0
#include "armature/report/report.hpp"

#include <string_view>

#include "armature/base/xml_text.hpp"
#include "armature/platform/file.hpp"
#include "armature/report/figures.hpp"
#include "armature/report/internal/page_parts.hpp"
#include "armature/report/page_data.hpp"
#include "armature/report/run_folder.hpp"

namespace armature::report {
namespace {

std::string make_page(const Runs& runs) {
  struct Part {
    std::string_view mark;
    std::string content;
  };
  const Part parts[] = {{"{{title}}", base::xml_escaped(title_of(runs))},
                        {"{{uplot.css}}", std::string(internal::kUplotCss)},
                        {"{{report.css}}", std::string(internal::kReportCss)},
                        {"{{data}}", page_json(runs)},
                        {"{{uplot.license}}", std::string(internal::kUplotLicense)},
                        {"{{uplot.js}}", std::string(internal::kUplotJs)},
                        {"{{elements.js}}", std::string(internal::kElementsJs)},
                        {"{{curves.js}}", std::string(internal::kCurvesJs)},
                        {"{{found.js}}", std::string(internal::kFoundJs)},
                        {"{{report.js}}", std::string(internal::kReportJs)}};
  std::string page;
  std::string_view rest = internal::kReportHtml;
  for (const Part& part : parts) {
    const std::size_t place = rest.find(part.mark);
    page += rest.substr(0, place);
    page += part.content;
    rest.remove_prefix(place + part.mark.size());
  }
  return page.append(rest);
}

void write(const std::string& path, const std::string& content, base::Diagnostics& diagnostics) {
  const auto written = platform::write_file(path, content);
  if (!written) diagnostics.error({}, written.error());
}

}  // namespace

Written write_report(const Options& options, base::Diagnostics& diagnostics) {
  Written written{options.page, options.folder + "/report.json"};
  if (written.page.empty()) written.page = options.folder + "/report.html";
  const Runs runs = load_runs(options.folder, diagnostics);
  if (!diagnostics.ok()) return written;
  write(written.page, make_page(runs), diagnostics);
  if (diagnostics.ok()) write(written.figures, figures_json(runs), diagnostics);
  return written;
}

}  // namespace armature::report
