// SPDX-License-Identifier: Apache-2.0
#include "app/ports/dds/security/participant_security.h"

#include <dds/dds.h>
#include <gmock/gmock.h>

#include "tests/app/ports/dds/security/test_keystore.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app::dds {
namespace {

namespace fs = std::filesystem;

std::string property(const Qos& qos, const char* name) {
  char* value = nullptr;
  if (!dds_qget_prop(qos.get(), name, &value)) return "";
  std::string text = value;
  dds_free(value);
  return text;
}

/// Keys are replaced by another link, also while they are being read.
TEST(ParticipantSecurity, ReadsTheFilesBehindALinkAsOneSet) {
  const orbwatch::tests::TemporaryFolder folder;
  tests::make_keystore(tests::keystore_request(folder / "old"));
  fs::create_directory_symlink("old", folder / "keys");
  const auto qos = security_qos({cli::enclave_folder(folder / "keys", "appliance")}, 1);
  ASSERT_TRUE(qos) << qos.error().message;
  const std::string real = "file:" + fs::canonical(folder / "old").string();
  for (const char* name : {"dds.sec.auth.identity_ca", "dds.sec.auth.identity_certificate",
                           "dds.sec.auth.private_key", "dds.sec.access.permissions_ca",
                           "dds.sec.access.governance", "dds.sec.access.permissions"}) {
    EXPECT_THAT(property(*qos, name), testing::StartsWith(real)) << name;
  }
}

}  // namespace
}  // namespace orbwatch::app::dds
