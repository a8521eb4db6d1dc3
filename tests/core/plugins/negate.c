/* A plugin in plain C, by abi.h alone: negates an image. Compiled several times, each time broken in another way:
 *  PLUGIN_NODE     name of its node
 *  PLUGIN_MAGIC, PLUGIN_MAJOR, PLUGIN_MINOR
 *  PLUGIN_SUMMARY  a null summary breaks the table
 *  PLUGIN_SYMBOL   the exported function
 *  PLUGIN_NEEDS    a function that nobody defines */
#include <quell/abi.h>

#ifndef PLUGIN_NODE
#define PLUGIN_NODE "negate"
#endif
#ifndef PLUGIN_MAGIC
#define PLUGIN_MAGIC QUELL_MAGIC
#endif
#ifndef PLUGIN_MAJOR
#define PLUGIN_MAJOR QUELL_ABI_MAJOR
#endif
#ifndef PLUGIN_MINOR
#define PLUGIN_MINOR QUELL_ABI_MINOR
#endif
#ifndef PLUGIN_SUMMARY
#define PLUGIN_SUMMARY "Negates every number, times a factor."
#endif
#ifndef PLUGIN_SYMBOL
#define PLUGIN_SYMBOL quell_plugin
#endif

#ifdef PLUGIN_NEEDS
extern float PLUGIN_NEEDS(float);
#define NEGATED(v) PLUGIN_NEEDS(v)
#else
#define NEGATED(v) (-(v))
#endif

typedef struct negate {
  float factor;
} negate;

static const quell_port inputs[] = {{"image", "Image.", QUELL_SCALAR, 0, -1, -1}};
static const quell_port outputs[] = {{"image", "The image, negated.", QUELL_SCALAR, 0, 0, -1}};
static const quell_param params[] = {{"factor", "Factor that each number is multiplied with.", QUELL_FLOAT, 1,
                                      offsetof(negate, factor), 0, 10, NULL, 0, 0}};
static const negate defaults = {1};

static int32_t run(const void* instance, const void* resource, const quell_tile* tile, quell_error* error) {
  const negate* self = (const negate*)instance;
  const quell_image* in = tile->in[0].image;
  const quell_image* out = &tile->out[0];
  (void)resource;
  (void)error;
  for (int32_t y = tile->y0; y < tile->y1; ++y)
    for (int32_t x = tile->x0; x < tile->x1; ++x)
      out->plane[0][y * out->pitch + x] = NEGATED(in->plane[0][y * in->pitch + x] * self->factor);
  return 0;
}

static const quell_node node = {
    .size = sizeof(quell_node),
    .name = PLUGIN_NODE,
    .summary = PLUGIN_SUMMARY,
    .source = "",
    .in = inputs,
    .in_count = 1,
    .out = outputs,
    .out_count = 1,
    .param = params,
    .param_count = 1,
    .instance_size = sizeof(negate),
    .instance_align = sizeof(float),
    .defaults = &defaults,
    .run = run,
};
static const quell_node* const nodes[] = {&node};
static const quell_plugin_table table = {
    PLUGIN_MAGIC, PLUGIN_MAJOR, PLUGIN_MINOR, sizeof(quell_plugin_table), 1, nodes, "1.0", "C",
};

__attribute__((visibility("default"))) const quell_plugin_table* PLUGIN_SYMBOL(void);
const quell_plugin_table* PLUGIN_SYMBOL(void) { return &table; }
