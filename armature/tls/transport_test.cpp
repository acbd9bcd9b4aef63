// SPDX-License-Identifier: Apache-2.0
#include "armature/tls/transport.hpp"

#include <gtest/gtest.h>

#include "armature/testing/transport_conformance.hpp"
#include "armature/tls/internal/test_certificates.hpp"

namespace armature::ride {
namespace {

using tls::internal::Folder;
using tls::internal::Issued;

/// Both ends have one certificate.
std::unique_ptr<Transport> make_tls() {
  const Folder folder;
  const Issued authority = tls::internal::make_authority();
  return tls::internal::transport_of(
      folder.write("robot", tls::internal::issue({}, &authority), authority));
}

INSTANTIATE_TEST_SUITE_P(Tls, TransportConformance,
                         testing::Values(TransportCase{"tls", make_tls,
                                                       [] {
                                                         return Address{"tls", "127.0.0.1", 0};
                                                       }}),
                         [](const auto& which) { return which.param.name; });

TEST(TlsTransport, IsSafeEverywhere) {
  const auto transport = make_tls();
  EXPECT_EQ(transport->scheme(), "tls");
  EXPECT_TRUE(transport->safe({"tls", "0.0.0.0", 1}));
}

TEST(TlsTransport, KeepsTheNameThatWasDialled) {
  const auto transport = make_tls();
  const auto by_name = transport->look_up({"tls", "localhost", 7});
  ASSERT_TRUE(by_name.ok()) << by_name.error();
  EXPECT_EQ(by_name.value().name, "localhost");
  EXPECT_NE(by_name.value().host, "localhost");
  EXPECT_EQ(transport->look_up({"tls", "127.0.0.1", 7}).value().name, "");
}

}  // namespace
}  // namespace armature::ride
