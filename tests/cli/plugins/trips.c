/* A plugin that copies radiance, TRIPS_GAIN times, and fails in one row of one frame, for runs that end in the middle.
 */
#include <quell/abi.h>

#include <stdio.h>

typedef struct trips {
  int32_t frame, row;
} trips;

static const quell_port inputs[] = {{"image", "Radiance.", QUELL_RADIANCE, 0, -1, -1}};
static const quell_port outputs[] = {{"image", "The same.", QUELL_RADIANCE, 0, 0, -1}};
static const quell_param params[] = {
    {"frame", "At which it fails.", QUELL_INT, 1, offsetof(trips, frame), 0, 1000, NULL, 0, 0},
    {"row", "At which it fails.", QUELL_INT, 1, offsetof(trips, row), 0, 1000, NULL, 0, 0}};
static const trips defaults = {0, 0};

static int32_t run(const void* instance, const void* resource, const quell_tile* tile, quell_error* error) {
  const trips* self = (const trips*)instance;
  const quell_image* in = tile->in[0].image;
  const quell_image* out = &tile->out[0];
  (void)resource;
  if (tile->frame == self->frame && tile->y0 <= self->row && self->row < tile->y1) {
    snprintf(error->text, sizeof error->text, "row %d is unlucky", (int)self->row);
    return 1;
  }
  for (int c = 0; c < 3; ++c)
    for (int32_t y = tile->y0; y < tile->y1; ++y)
      for (int32_t x = tile->x0; x < tile->x1; ++x)
        out->plane[c][y * out->pitch + x] = TRIPS_GAIN * in->plane[c][y * in->pitch + x];
  return 0;
}

static const quell_node node = {
    .size = sizeof(quell_node),
    .name = "trips",
    .summary = "Fails.",
    .source = "",
    .in = inputs,
    .in_count = 1,
    .out = outputs,
    .out_count = 1,
    .param = params,
    .param_count = 2,
    .instance_size = sizeof(trips),
    .instance_align = sizeof(int32_t),
    .defaults = &defaults,
    .run = run,
};
static const quell_node* const nodes[] = {&node};
static const quell_plugin_table table = {
    QUELL_MAGIC, QUELL_ABI_MAJOR, QUELL_ABI_MINOR, sizeof(quell_plugin_table), 1, nodes, TRIPS_VERSION, "C",
};

__attribute__((visibility("default"))) const quell_plugin_table* quell_plugin(void);
const quell_plugin_table* quell_plugin(void) { return &table; }
