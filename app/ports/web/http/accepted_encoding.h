// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/ports/web/http/message.h"

namespace orbwatch::app::web {

/// Returns whether Accept-Encoding (RFC 9110, 12.5.3) permits gzip and does not prefer the content
/// as it is. A client that does not send the header gets the content as it is. Reentrant.
bool accepts_gzip(const Request& request);

}  // namespace orbwatch::app::web
