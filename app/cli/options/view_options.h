#pragma once

#include <vector>

#include "app/cli/options/options.h"
#include "proc/optics/view_projection.h"

namespace orbwatch::app {

/// The defaults of a view.
inline constexpr optics::ViewSpec kDefaultView{
    optics::ViewKind::Perspective, {}, {}, {}, 1280, 720};

/// The options that describe a view; they write into `view`, which outlives them.
std::vector<Option> view_options(optics::ViewSpec& view);

}  // namespace orbwatch::app
