// SPDX-License-Identifier: Apache-2.0
#include "armature/bundle/texts.hpp"

#include <algorithm>
#include <cctype>
#include <chrono>

namespace armature::bundle {
namespace {

bool is_plain(unsigned char letter) {
  return std::isalnum(letter) != 0 || letter == '.' || letter == '_' || letter == '-';
}

template <typename Texts>
std::string joined(const Texts& texts, std::string_view between) {
  std::string result;
  for (const std::string& text : texts) {
    if (!result.empty()) result += between;
    result += text;
  }
  return result;
}

std::string paragraph(std::string_view head, const std::vector<std::string>& lines) {
  if (lines.empty()) return {};
  return "\n" + std::string(head) + "\n\n  " + joined(lines, "\n  ") + "\n";
}

}  // namespace

std::string name_of_bundle(std::string_view application) {
  const bool fits = !application.empty() && application.front() != '.' &&
                    application.front() != '-' && std::ranges::all_of(application, is_plain);
  return fits ? std::string(application) : std::string();
}

std::string name_of_package(std::string_view name) {
  std::string package = "armature-" + std::string(name);
  for (char& letter : package) {
    letter =
        letter == '_' ? '-' : static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  }
  return package;
}

std::string name_of_unit(std::string_view name) { return std::string(name) + ".service"; }

std::string name_of_archive(const Facts& facts) {
  return name_of_package(facts.name) + "_" + facts.version + "_" + facts.architecture + ".deb";
}

std::string installed_folder(std::string_view name) { return "/opt/armature/" + std::string(name); }

std::string shell_word(std::string_view text) {
  std::string word = "'";
  for (const char letter : text) word += letter == '\'' ? "'\\''" : std::string(1, letter);
  return word + "'";
}

std::string run_script(const Facts& facts) {
  std::string options;
  for (const std::string& word : facts.options) options += " " + shell_word(word);
  if (!facts.script.empty()) options += " --script \"$here\"/" + shell_word(facts.script);
  return "#!/bin/sh\n"
         "# Runs this deployment; arguments are those of `armature run`.\n"
         "here=$(dirname -- \"$(readlink -f -- \"$0\")\")\n"
         "exec \"$here/bin/armature\" run \"$here\"/" +
         shell_word(facts.deployment) + options + " \"$@\"\n";
}

std::string unit_text(const Facts& facts) {
  const std::string folder = installed_folder(facts.name);
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(facts.stop_time).count();
  return "# Runs " + folder +
         ". It arms nothing: that stays with the operator.\n"
         "[Unit]\n"
         "Description=" +
         facts.name +
         ", run by Armature\n"
         "Documentation=file:" +
         folder +
         "/README\n"
         "After=network.target\n"
         "\n"
         "[Service]\n"
         "Type=exec\n"
         "ExecStart=" +
         folder +
         "/run\n"
         "# A robot that has stopped is looked at before it runs again.\n"
         "Restart=no\n"
         "# What is written to the working directory, such as recordings, is in /var/lib.\n"
         "StateDirectory=armature/" +
         facts.name +
         "\n"
         "WorkingDirectory=%S/armature/" +
         facts.name +
         "\n"
         "\n"
         "# An orderly stop, as by Ctrl-C. The guardian outlives it: it switches the drives off.\n"
         "KillSignal=SIGTERM\n"
         "KillMode=process\n"
         "TimeoutStopSec=" +
         std::to_string(seconds) +
         "\n"
         "\n"
         "# Real time.\n"
         "LimitRTPRIO=99\n"
         "LimitMEMLOCK=infinity\n"
         "\n"
         "# It runs as root, whose is /dev/cpu_dma_latency, with none of root's powers but one: "
         "to\n"
         "# have threads scheduled by deadlines. Devices stay visible: they may be the robot's.\n"
         "CapabilityBoundingSet=CAP_SYS_NICE\n"
         "NoNewPrivileges=yes\n"
         "ProtectSystem=strict\n"
         "ReadWritePaths=/run" +
         (facts.saved.empty() ? std::string() : " " + folder + "/deployment") +
         "\n"
         "ProtectHome=yes\n"
         "ProtectControlGroups=yes\n"
         "ProtectHostname=yes\n"
         "ProtectKernelLogs=yes\n"
         "ProtectKernelModules=yes\n"
         "ProtectKernelTunables=yes\n"
         "RestrictAddressFamilies=AF_UNIX AF_INET AF_INET6 AF_CAN AF_NETLINK\n"
         "RestrictNamespaces=yes\n"
         "RestrictSUIDSGID=yes\n"
         "LockPersonality=yes\n"
         "MemoryDenyWriteExecute=yes\n"
         "SystemCallArchitectures=native\n"
         "\n"
         "[Install]\n"
         "WantedBy=multi-user.target\n";
}

std::string readme_text(const Facts& facts) {
  return facts.name + ": a deployment and the Armature " + facts.version +
         " that runs it, for Debian 12 on " + facts.architecture +
         "\n\n"
         "  ./run --sim --for 10s     in simulated time, if its robot is simulated\n"
         "  ./run                     in real time, until Ctrl-C\n"
         "  bin/armature check " +
         facts.deployment +
         "\n"
         "  sha256sum -c SHA256SUMS   whether all files are as they were made\n"
         "\n"
         "run starts the deployment from wherever this folder lies, and passes its arguments on "
         "to\n"
         "`armature run`; `./run --help` lists them. It needs these packages of Debian 12:\n"
         "\n"
         "  apt install " +
         joined(facts.packages, " ") + "\n" +
         paragraph(
             "It needs libraries that belong to no package of the machine that made it; install "
             "them by\nhand:",
             facts.strangers) +
         paragraph("Private keys are not in here. Put them by hand to:", facts.keys) +
         paragraph("A run writes these files when it stops:", facts.saved) +
         "\n"
         "As a service it lies in " +
         installed_folder(facts.name) +
         ", where the Debian package puts it, and is\n"
         "started by `systemctl start " +
         facts.name +
         "`. Nothing starts it at boot before\n"
         "`systemctl enable " +
         facts.name + "`. Without the package, copy " + facts.name +
         ".service to /etc/systemd/system.\n"
         "\n"
         "  run, which starts it\n"
         "  bin and lib, Armature and its component libraries\n"
         "  deployment, the deployment's files as they were\n"
         "  " +
         name_of_unit(facts.name) +
         ", the unit for systemd\n"
         "  LICENSE and licences, of Armature and of what it needs\n";
}

std::string licences_text(const Facts& facts) {
  std::string text =
      "Armature, in bin and lib: Apache-2.0, see LICENSE. The deployment and component libraries "
      "that\n"
      "are not of Armature have the licences of their authors.\n"
      "\n"
      "Debian packages that are needed and not in here, and where their licences are once they "
      "are\n"
      "installed:\n\n";
  for (const std::string& package : facts.packages) {
    text += package + ": /usr/share/doc/" + package + "/copyright\n";
  }
  return text;
}

std::string control_text(const Facts& facts, std::uint64_t kilobytes) {
  std::string text = "Package: " + name_of_package(facts.name) +
                     "\n"
                     "Version: " +
                     facts.version +
                     "\n"
                     "Architecture: " +
                     facts.architecture +
                     "\n"
                     "Maintainer: whoever made this bundle <root@localhost>\n"
                     "Installed-Size: " +
                     std::to_string(kilobytes) + "\n";
  if (!facts.packages.empty()) text += "Depends: " + joined(facts.packages, ", ") + "\n";
  return text +
         "Section: misc\n"
         "Priority: optional\n"
         "Description: " +
         facts.name +
         ", run by Armature\n"
         " A deployment and the programs and libraries of Armature that run it. Installing it "
         "enables\n"
         " and starts nothing; " +
         installed_folder(facts.name) + "/README says how it is started.\n";
}

}  // namespace armature::bundle
