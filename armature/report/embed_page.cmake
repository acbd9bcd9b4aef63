# SPDX-License-Identifier: Apache-2.0
# Writes the page's files as texts of C++:
#   cmake -D PAGE=<folder> -D UPLOT=<folder> -D OUTPUT=<file.cpp> -P embed_page.cmake
set(source "#include \"armature/report/internal/page_parts.hpp\"\n\nnamespace armature::report::internal {\n")
foreach(part IN ITEMS "kReportHtml|${PAGE}/report.html" "kReportCss|${PAGE}/report.css"
                      "kReportJs|${PAGE}/report.js" "kCurvesJs|${PAGE}/curves.js" "kElementsJs|${PAGE}/elements.js"
                      "kFoundJs|${PAGE}/found.js"
                      "kUplotCss|${UPLOT}/dist/uPlot.min.css"
                      "kUplotJs|${UPLOT}/dist/uPlot.iife.min.js" "kUplotLicense|${UPLOT}/LICENSE")
  string(REPLACE "|" ";" part "${part}")
  list(GET part 0 name)
  list(GET part 1 path)
  file(READ ${path} text)
  string(APPEND source "const std::string_view ${name} = R\"armature(${text})armature\";\n")
endforeach()
string(APPEND source "}  // namespace armature::report::internal\n")
file(WRITE ${OUTPUT} "${source}")
