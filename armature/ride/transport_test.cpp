// SPDX-License-Identifier: Apache-2.0
#include "armature/ride/transport.hpp"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <unistd.h>

#include "armature/testing/transport_conformance.hpp"

namespace armature::ride {
namespace {

std::string socket_file(const std::string& name) {
  return testing::TempDir() + "ride_" + std::to_string(::getpid()) + "_" + name;
}

INSTANTIATE_TEST_SUITE_P(
    All, TransportConformance,
    testing::Values(TransportCase{"tcp", make_tcp_transport,
                                  [] {
                                    return Address{"tcp", "127.0.0.1", 0};
                                  }},
                    TransportCase{"unix", [] { return make_unix_transport(); },
                                  [] {
                                    return Address{"unix", socket_file("conformance"), 0};
                                  }}),
    [](const auto& which) { return which.param.name; });

TEST(TcpTransport, IsSafeOnLoopbackOnly) {
  const auto tcp = make_tcp_transport();
  EXPECT_TRUE(tcp->safe({"tcp", "127.0.0.1", 1}));
  EXPECT_TRUE(tcp->safe({"tcp", "127.9.9.9", 1}));
  EXPECT_TRUE(tcp->safe({"tcp", "::1", 1}));
  EXPECT_TRUE(tcp->safe({"tcp", "localhost", 1}));
  EXPECT_FALSE(tcp->safe({"tcp", "0.0.0.0", 1}));
  EXPECT_FALSE(tcp->safe({"tcp", "::", 1}));
  EXPECT_FALSE(tcp->safe({"tcp", "192.168.1.1", 1}));
  EXPECT_FALSE(tcp->safe({"tcp", "no.such.host.invalid", 1}));
}

TEST(UnixTransport, LeavesAFileAloneThatIsNoSocket) {
  const std::string path = socket_file("file");
  std::ofstream(path) << "precious";
  const auto listener = make_unix_transport()->listen({"unix", path, 0});
  ASSERT_FALSE(listener.ok());
  EXPECT_NE(listener.error().find("is not a socket file"), std::string::npos) << listener.error();
  EXPECT_TRUE(std::filesystem::remove(path));
}

TEST(UnixTransport, SaysHowLongAPathMayBe) {
  const auto listener = make_unix_transport()->listen({"unix", std::string(200, 'x'), 0});
  ASSERT_FALSE(listener.ok());
  EXPECT_NE(listener.error().find("1 to 107 letters, but has 200"), std::string::npos)
      << listener.error();
}

}  // namespace
}  // namespace armature::ride
