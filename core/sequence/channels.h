// Which channels of a file play a role.
#pragma once

#include "core/report/diagnostics.h"
#include "core/sequence/sequence.h"

#include <string>
#include <vector>

namespace quell {

// Those among a file's `names` that the choice asks for; none when some are not there.
std::vector<std::string> find_channels(const std::vector<std::string>& names, const ChannelChoice&, int type);
// Says what the file at `path` has in place of the channels that an input asks for.
void report_channels(const SequenceInput&, const std::string& path, const std::vector<std::string>& names,
                     Diagnostics&);

}  // namespace quell
