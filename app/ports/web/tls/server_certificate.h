// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/certificates/certificate.h"
#include "app/certificates/dates.h"
#include "app/ports/web/http/pem_pair.h"
#include "app/ports/web/web_settings.h"
#include "proc/image/result.h"

/// Certificate for HTTPS: one configured in the site file, or a self-made one kept in the state
/// folder. All reentrant; they wait for the disk.
namespace orbwatch::app::web {

struct ServerCertificate {
  PemPair pem;
  ValidityPeriod validity;
  std::string fingerprint;  ///< SHA-256
  bool is_self_made = false;
};

/// Longest validity that Apple's systems accept, minus a day for clock differences.
inline constexpr std::chrono::days kSelfMadeDays{824};
/// Time before its expiry at which a self-made certificate is replaced.
inline constexpr std::chrono::days kRenewedBefore{60};

/// Certificate and key named in the settings. Errors name the file: not readable, malformed, a
/// world-readable key, a key that does not match, or a certificate that is not valid `now`.
Result<ServerCertificate> named_certificate(const WebSettings& settings, const Now& now);

/// The self-made certificate in the state folder; nullopt: none. Errors: those of read_private();
/// damaged.
Result<std::optional<ServerCertificate>> kept_certificate(const std::filesystem::path& folder);

/// State of the system's clock: Unsure until it follows a time server.
enum class ClockState { Unsure, Synchronised };

/// The kept certificate if it is usable, not due and made for `hosts`; otherwise a new one, kept
/// with mode 0600. Logs why a kept one is not usable. Error: a new one cannot be written.
Result<ServerCertificate> self_made_certificate(const std::filesystem::path& folder,
                                                const std::vector<std::string>& hosts,
                                                std::chrono::sys_seconds now,
                                                ClockState clock = ClockState::Unsure);

/// Returns whether a self-made certificate is to be replaced: it expires soon, or `clock` is
/// synchronised and the certificate begins in the future, made while the clock was ahead. With an
/// unsure clock the latter is kept, because the clock is as likely to be behind.
bool is_due(const ServerCertificate& certificate, std::chrono::sys_seconds now,
            ClockState clock = ClockState::Unsure);

/// Names and addresses by which this computer is reached, as far as they are known in advance.
std::vector<std::string> own_hosts(const WebSettings& settings);

/// Text such as "self-made certificate, valid until 2028-02-27, SHA-256 fingerprint 01:23:...".
std::string certificate_text(const ServerCertificate& certificate);

}  // namespace orbwatch::app::web
