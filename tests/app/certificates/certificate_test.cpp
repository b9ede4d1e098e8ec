// SPDX-License-Identifier: Apache-2.0
#include "app/certificates/certificate.h"

#include <gtest/gtest.h>
#include <openssl/asn1.h>

namespace orbwatch::app {
namespace {

using namespace std::chrono;

/// Self-signed certificate, after reading it back.
Certificate certificate_for(const ValidityPeriod& validity) {
  const auto credential = make_credential("ball", CertificateUse::Serve, validity);
  EXPECT_TRUE(credential);
  return certificate_from_pem(to_pem(credential->certificate).value()).value();
}

std::string as_written(const ASN1_TIME* time) {
  return {reinterpret_cast<const char*>(ASN1_STRING_get0_data(time)),
          static_cast<std::size_t>(ASN1_STRING_length(time))};
}

/// A time_t of 32 bit ends in January 2038.
TEST(CertificateDates, BeyondTheEndOf32BitAreWrittenAndReadAsTheyAre) {
  const ValidityPeriod validity{sys_days(2045y / July / 1) + 1h + 2min + 3s,
                                sys_days(2105y / December / 31) + 23h + 59min + 59s};
  const Certificate certificate = certificate_for(validity);
  EXPECT_EQ(as_written(X509_get0_notBefore(certificate.get())), "450701010203Z");
  EXPECT_EQ(as_written(X509_get0_notAfter(certificate.get())), "21051231235959Z")
      << "RFC 5280, 4.1.2.5: from 2050 on with four digits of the year";
  const auto read = validity_of(certificate);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->from, validity.from);
  EXPECT_EQ(read->until, validity.until);
  EXPECT_GT((read->until - read->from) / days(1), 22000);
}

TEST(CertificateDates, AsTextBeyondTheEndOf32Bit) {
  constexpr const char* kFormat = "%Y-%m-%d %H:%M";
  EXPECT_EQ(date_text(sys_days(2045y / July / 1) + 90min, kFormat), "2045-07-01 01:30");
  EXPECT_EQ(date_text(sys_days(2105y / December / 31), kFormat), "2105-12-31 00:00");
  EXPECT_EQ(date_text(sys_days(1969y / December / 31), kFormat), "1969-12-31 00:00");
}

}  // namespace
}  // namespace orbwatch::app
