// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

/// The texts of a bundle; `@name@` keeps the place of a word.
namespace armature::bundle::internal {

inline constexpr std::string_view kRun = R"sh(#!/bin/sh
# Runs this deployment; arguments are those of `armature run`.
here=$(dirname -- "$(readlink -f -- "$0")")
exec "$here/bin/armature" run "$here"/@deployment@@options@ "$@"
)sh";

inline constexpr std::string_view kUnit =
    R"(# Runs @folder@. It arms nothing: that stays with the operator.
[Unit]
Description=@name@, run by Armature
Documentation=file:@folder@/README
After=network.target

[Service]
Type=exec
ExecStart=@folder@/run
# A robot that has stopped is looked at before it runs again.
Restart=no
# What is written to the working directory, such as recordings, is in /var/lib.
StateDirectory=armature/@name@
WorkingDirectory=%S/armature/@name@

# An orderly stop, as by Ctrl-C. The guardian outlives it: it switches the drives off.
KillSignal=SIGTERM
KillMode=process
TimeoutStopSec=@seconds@

# Real time.
LimitRTPRIO=99
LimitMEMLOCK=infinity

# It runs as root, who owns /dev/cpu_dma_latency, with one of root's powers: threads with deadlines.
# Devices stay visible: they may be the robot's.
CapabilityBoundingSet=CAP_SYS_NICE
NoNewPrivileges=yes
ProtectSystem=strict
ReadWritePaths=/run@saved@
ProtectHome=yes
ProtectControlGroups=yes
ProtectHostname=yes
ProtectKernelLogs=yes
ProtectKernelModules=yes
ProtectKernelTunables=yes
RestrictAddressFamilies=AF_UNIX AF_INET AF_INET6 AF_CAN AF_NETLINK
RestrictNamespaces=yes
RestrictSUIDSGID=yes
LockPersonality=yes
MemoryDenyWriteExecute=yes
SystemCallArchitectures=native

[Install]
WantedBy=multi-user.target
)";

inline constexpr std::string_view kReadme =
    R"(@name@: a deployment and the Armature @version@ that runs it, for Debian 12 on @architecture@.

  ./run --sim --for 10s      in simulated time, if its robot is simulated
  ./run                      in real time, until Ctrl-C
  bin/armature check @deployment@
  sha256sum -c SHA256SUMS    are all files as they were made?

run starts the deployment from wherever this folder lies, and passes its arguments on to
`armature run`; `./run --help` lists them. It needs these packages of Debian 12:

  apt install @packages@
@strangers@@keys@@saved@
As a service it lies in @folder@, where the Debian package puts it.
`systemctl start @name@` starts it; at boot it starts only after `systemctl enable @name@`.
Without the package, copy this folder there and @unit@ to /etc/systemd/system.

What is in here:

  run                  starts it
  bin, lib             Armature and the component libraries that are needed
  deployment           the deployment's files as they were
  *.service            the unit for systemd
  LICENSE, licences    of Armature and of what it needs
)";

inline constexpr std::string_view kLicences =
    R"(Armature, in bin and lib: Apache-2.0, see LICENSE. The deployment and component libraries that
are not of Armature have the licences of their authors.

Debian packages that are needed and not in here, and where their licences are once they are
installed:

@list@)";

inline constexpr std::string_view kControl = R"(Package: @package@
Version: @version@
Architecture: @architecture@
Maintainer: whoever made this bundle <root@localhost>
Installed-Size: @kilobytes@
@depends@Section: misc
Priority: optional
Description: @name@, run by Armature
 A deployment and the programs and libraries of Armature that run it. Installing it enables
 and starts nothing; @folder@/README says how it is started.
)";

}  // namespace armature::bundle::internal
