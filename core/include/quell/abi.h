/* The whole contract between Quell and a plugin, in plain C11.
 *
 * A plugin is a shared library that exports one function, quell_plugin(), which returns a table of nodes. C++ authors
 * include <quell/node.h>, which builds the table from a struct; this header is all that any other language needs.
 *
 * Rules that both sides keep:
 *  - Tables and all that they point to are constant and live as long as the process; a plugin is never unloaded.
 *  - A node is a pure function: run and weigh read the instance, the resource and their inputs, and write their
 * outputs.
 *  - Callbacks are called from several threads at once, on different tiles. A plugin starts no thread of its own.
 *  - No exception crosses. A callback that can fail returns nonzero and fills quell_error.
 *  - Images hold finite numbers. Every pixel of an output's tile is written.
 */
#ifndef QUELL_ABI_H
#define QUELL_ABI_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A plugin loads iff its major equals the host's and its minor is not greater.
 *  1.0  2026-11-22  first version */
#define QUELL_ABI_MAJOR 1
#define QUELL_ABI_MINOR 0
#define QUELL_MAGIC 0x4c4c4551u /* "QELL" */

/* What an image means. Channels, conventions and what a missing history reads as are in <quell/types.h>. */
typedef enum quell_type {
  QUELL_RADIANCE = 1,
  QUELL_ALBEDO = 2,
  QUELL_NORMAL = 3,
  QUELL_DEPTH = 4,
  QUELL_SLOPE = 5,
  QUELL_POSITION = 6,
  QUELL_MOTION = 7,
  QUELL_ID = 8,
  QUELL_VARIANCE = 9,
  QUELL_MOMENTS = 10,
  QUELL_COUNT = 11,
  QUELL_TAPS = 12,
  QUELL_SCALAR = 13,
  QUELL_FEATURES = 14,
  QUELL_DISPLAY = 15,
  QUELL_VALUE = 16,
  QUELL_CAMERA = 17,
  QUELL_TRANSFORMS = 18,
  QUELL_WEIGHT = 19, /* no image: the port takes or gives an edge-stopping function */
  QUELL_ANY = 100    /* a type variable over float images: all `any` ports of one node have one type, but for a
                      * list of a node without `any` outputs, whose images have a type each */
} quell_type;

typedef enum quell_kind {                   /* of a parameter, and how it lies in the instance */
                          QUELL_BOOL = 1,   /* uint8_t, 0 or 1 */
                          QUELL_INT = 2,    /* int32_t */
                          QUELL_FLOAT = 3,  /* float */
                          QUELL_CHOICE = 4, /* int32_t, index into choices */
                          QUELL_FLOATS = 5, /* float[count] */
                          QUELL_TEXT = 6,   /* quell_text */
                          QUELL_PATH = 7    /* quell_text: a file, absolute once the host has resolved it */
} quell_kind;

typedef struct quell_text { /* UTF-8; the host owns the bytes, which end in a NUL and live as long as the instance */
  const char* data;
  size_t size; /* without the NUL */
} quell_text;

typedef struct quell_error {
  char text[1024]; /* NUL-terminated; the host adds node, frame and tile */
} quell_error;

/* ---- Description ------------------------------------------------------------------------------------------------ */

enum {                      /* quell_port.flags */
       QUELL_OPTIONAL = 1u, /* input: may be left unconnected */
       QUELL_LIST = 2u      /* input: takes any number of wires */
};

typedef struct quell_port {
  const char* name; /* [a-z][a-z0-9_]* */
  const char* doc;
  int32_t type; /* quell_type */
  uint32_t flags;
  int32_t passes; /* output: input that stands in for it when the node is bypassed, or -1 */
  int32_t with;   /* output: exists only when this input is connected, or -1 */
} quell_port;

typedef struct quell_param {
  const char* name;
  const char* doc;
  int32_t kind;    /* quell_kind */
  int32_t count;   /* QUELL_FLOATS: how many; else 1 */
  size_t offset;   /* in the instance */
  double min, max; /* inclusive; of each number. -INFINITY and INFINITY where unbounded */
  const char* const* choices;
  int32_t choice_count;
  int32_t reserved;
} quell_param;

/* How far from an output pixel an input is read, pixels. All zero: at the pixel itself. */
typedef struct quell_reach {
  int32_t left, right, up, down;
  int32_t anywhere; /* 1: any pixel of the image */
  int32_t step;     /* > 1: rows y, y + step, y + 2 step, … are read together, so tall tiles visited by residue pay */
} quell_reach;

typedef struct quell_shape {
  int32_t width, height, channels;
} quell_shape;

/* ---- Execution -------------------------------------------------------------------------------------------------- */

/* Planar float32 (uint32 in the planes of `id` and the mask plane of `taps`). Pixel (x, y) of channel c is
 * plane[c][y * pitch + x]. Planes are aligned to 64 bytes and so is each row. All images of one width have one pitch,
 * so one offset serves all inputs of a node. Beyond either end of a row QUELL_MARGIN floats may be read (their values
 * are of no meaning), and a row of an output may be written up to a multiple of 16 floats. */
#define QUELL_MARGIN 192

typedef struct quell_image {
  float* const* plane;
  int32_t width, height, channels;
  int32_t missing; /* 1: a delayed wire that has no past; every pixel reads as its type's missing value */
  ptrdiff_t pitch; /* floats from a row to the next */
} quell_image;

struct quell_bound_weight;

typedef struct quell_input {               /* one input port */
  const quell_image* image;                /* `count` images, or NULL for a port of type weight */
  const struct quell_bound_weight* weight; /* `count` functions, or NULL */
  int32_t count;                           /* 0: not connected; more than 1 only for lists */
} quell_input;

/* What run is to do: fill columns [x0, x1) of rows [y0, y1) of every output. Outputs that are tables or values, beside
 * outputs that are pixels, are no part of the rectangle: the tile that holds (0, 0) writes them in whole. */
typedef struct quell_tile {
  const quell_input* in;
  const quell_image* out; /* one an output port; plane is NULL for an output that does not exist (quell_port.with) */
  int32_t x0, y0, x1, y1;
  int64_t frame; /* absolute number */
} quell_tile;

/* A tap: pixel (x + dx, y + dy) seen from (x, y). */
typedef struct quell_tap {
  ptrdiff_t offset; /* dy * pitch + dx */
  int32_t dx, dy;
} quell_tap;

/* n pixels of one row and a batch of taps. Taps come in mirrored pairs, 2k at +o and 2k + 1 at -o, except where the
 * image border or `taps` being odd leaves one alone: `paired` says whether all are. */
#define QUELL_MAX_TAPS 32
#define QUELL_SEGMENT 128

typedef struct quell_run {
  int32_t x, y, n; /* pixels (x … x + n - 1, y), 1 <= n <= QUELL_SEGMENT */
  int32_t taps;    /* 1 <= taps <= QUELL_MAX_TAPS */
  const quell_tap* tap;
  ptrdiff_t at;  /* y * pitch + x: where the run starts in every plane */
  ptrdiff_t row; /* floats from exponent[t] to exponent[t + 1] */
  int32_t paired;
  int32_t store; /* 1: store the exponents; 0: add to what is there */
} quell_run;

/* A weight node, bound to its inputs. Fills exponent[t * row + i] for tap t and pixel i: log2 units, >= 0, +inf for
 * "never"; the weight of the tap is 2 to the minus the sum of all weight nodes' exponents. May compute and write up to
 * n rounded up to a multiple of 32. */
typedef struct quell_bound_weight {
  void (*weigh)(const void* instance, const void* resource, const quell_input* in, const quell_run* run,
                float* exponent);
  const void* instance;
  const void* resource;
  const quell_input* in; /* inputs of the weight node, ready to read as far as the filter's reach plus their own */
} quell_bound_weight;

typedef struct quell_spec { /* what is known when a graph has been planned */
  const quell_shape* in;    /* one an input port: shape of its first image; zero where not connected or a weight */
  const int32_t* in_count;
  const int32_t* in_channels; /* one an input port: channels of all its images together */
} quell_spec;

typedef struct quell_node {
  uint32_t size;       /* sizeof(quell_node) */
  const char* name;    /* [a-z][a-z0-9_]*; the library is called after its node: <name>.so */
  const char* summary; /* one sentence */
  const char* source;  /* paper and equation, or "" */
  const quell_port* in;
  int32_t in_count;
  const quell_port* out;
  int32_t out_count;
  const quell_param* param;
  int32_t param_count;
  /* An instance: the host copies `defaults` to memory of this size and alignment, and writes parameters at their
   * offsets. */
  size_t instance_size, instance_align;
  const void* defaults;
  /* How far each input is read, a function of the parameters; reach[in_count] comes zeroed. NULL: at the pixel. */
  void (*reach)(const void* instance, quell_reach* reach);
  /* Shapes of the outputs, which come filled by the host: width and height of the first connected image input, channels
   * of the type (for any: of the first input of type any; for features: of the first features input). NULL: these hold.
   * Required of a node without image inputs. */
  int32_t (*shapes)(const void* instance, const quell_spec*, quell_shape* out, quell_error*);
  /* Makes an immutable resource for run and weigh. NULL in both places if there is none. */
  int32_t (*prepare)(const void* instance, const quell_spec*, void** resource, quell_error*);
  void (*release)(void* resource);
  /* Exactly one of the two. A weight node has weigh, and one output, of type weight. */
  int32_t (*run)(const void* instance, const void* resource, const quell_tile*, quell_error*);
  void (*weigh)(const void* instance, const void* resource, const quell_input* in, const quell_run*, float* exponent);
} quell_node;

typedef struct quell_plugin_table {
  uint32_t magic; /* QUELL_MAGIC */
  uint16_t abi_major, abi_minor;
  uint32_t size; /* sizeof(quell_plugin_table) */
  int32_t node_count;
  const quell_node* const* nodes;
  const char* version;  /* of the plugin */
  const char* compiler; /* that built it */
} quell_plugin_table;

/* Every plugin exports `const quell_plugin_table* quell_plugin(void)`. */
typedef const quell_plugin_table* (*quell_plugin_function)(void);

#ifdef __cplusplus
}
#endif
#endif
