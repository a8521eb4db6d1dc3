// Parameters of graphs/games202.json's filter, for its opponents.
#pragma once

namespace quell::bench {

struct WindowRule {
  int radius = 16;
  float sigma_distance = 32, sigma_color = 0.6f, sigma_normal = 0.1f, sigma_plane = 0.1f;
};

}  // namespace quell::bench
