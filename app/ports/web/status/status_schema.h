// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/ports/web/api/json_form.h"

namespace orbwatch::app::web {

/// Schema of the status, generated from the fields of its parts. Reentrant.
Json status_schema();

}  // namespace orbwatch::app::web
