// What the path tracer says about bad scene files.
#include "plugins/path_tracer/test_scenes.h"

namespace {

using namespace path_tracer_test;

std::string complaint(const std::string& text) {
  const std::string file = scene_file("bad", text);
  try {
    tracer(file, 4, 4).run();
  } catch (const std::exception& e) {
    std::string what = e.what();
    for (auto at = what.find(file); at != std::string::npos; at = what.find(file)) what.replace(at, file.size(), "S");
    return what;
  }
  return "no error";
}

// A scene with one material and one shape, given as text.
std::string with(const std::string& material, const std::string& shape) {
  return std::string(kHead) + R"("materials": { "m": )" + material + R"( }, "objects": [{ "name": "o", "shapes": [)" +
         shape + "] }] }";
}

const char* const kGrey = R"({ "type": "diffuse", "color": [0.5, 0.5, 0.5] })";
const char* const kBall = R"({ "type": "sphere", "material": "m", "center": [0, 0, 0], "radius": 1 })";

TEST(PathTracerErrors, NameTheOffenderItsValueAndTheWayOut) {
  EXPECT_EQ(complaint(with(kGrey, kBall)), "no error");
  EXPECT_EQ(complaint(with(R"({ "type": "velvet" })", kBall)),
            "S: materials.m.type: \"velvet\" is not one of: diffuse, plastic, conductor, mirror, glass, emitter");
  EXPECT_EQ(complaint(with(R"({ "type": "conductor", "color": [1, 1, 1], "roughness": 3 })", kBall)),
            "S: materials.m.roughness: 3 is out of range; it must be from 0.03 to 1");
  EXPECT_EQ(
      complaint(with(R"({ "type": "diffuse", "colour": [1, 1, 1] })", kBall)),
      "S: materials.m.colour: unknown key; known here: type, color, roughness, ior, radiance, strength, two_sided\n"
      "S: materials.m.color: missing");
  EXPECT_EQ(complaint(with(R"({ "type": "diffuse", "color": [1, 1.5, 1] })", kBall)),
            "S: materials.m.color[1]: 1.5 is out of range; it must be from 0 to 1");
  EXPECT_EQ(complaint(with(kGrey, R"({ "type": "sphere", "material": "gold", "center": [0, 0, 0], "radius": 1 })")),
            "S: objects[0].shapes[0].material: no material is called 'gold'; there are: m");
  EXPECT_EQ(complaint(with(kGrey, R"({ "type": "sphere", "material": "m", "center": [0, 0], "radius": "big" })")),
            "S: objects[0].shapes[0].center: [0,0] is not an array of 3 numbers\n"
            "S: objects[0].shapes[0].radius: \"big\" is not a number");
  EXPECT_EQ(complaint(with(
                kGrey, R"({ "type": "quad", "material": "m", "corner": [0, 0, 0], "u": [1, 0, 0], "v": [2, 0, 0] })")),
            "S: objects[0].shapes[0].v: 'u' and 'v' must span an area");
  EXPECT_EQ(
      complaint(with(R"({ "type": "emitter", "radiance": [1, 1, 1] })",
                     R"({ "type": "frustum", "material": "m", "from": [0, 0, 0], "to": [0, 1, 0], "radius": 1 })")),
      "S: objects[0].shapes[0].material: a frustum cannot emit; emitters are quads, boxes, spheres, disks and meshes");
}

TEST(PathTracerErrors, Files) {
  EXPECT_EQ(complaint("{ \"quell_scene\": 2 }").substr(0, 53), "S: quell_scene: must be 1, the version of this format");
  EXPECT_EQ(complaint(std::string(kHead) + R"("about": "a", "about": "b" })"),
            "S: key 'about' stands twice in one object; remove one");
  EXPECT_EQ(complaint("{\n  \"quell_scene\": 1,,\n}").substr(0, 23), "S:2:20: not valid JSON:");
  try {
    tracer("/no/such/scene.json", 4, 4).run();
    FAIL();
  } catch (const std::exception& e) {
    EXPECT_STREQ(e.what(), "/no/such/scene.json: cannot open the scene file; set 'scene' to one that exists");
  }
}

TEST(PathTracerErrors, Keys) {
  const auto animated = [](const std::string& keys) {
    return std::string(kHead) + R"("loop": 8, "materials": { "m": { "type": "diffuse", "color": [0.5, 0.5, 0.5] } },
      "objects": [{ "name": "o", "keys": )" +
           keys + R"(, "shapes": [{ "type": "sphere", "material": "m", "center": [0, 0, 0], "radius": 1 }] }] })";
  };
  EXPECT_EQ(complaint(animated(R"([{ "at": 0 }, { "at": 8, "translate": [1, 0, 0] }])")), "no error");
  EXPECT_EQ(complaint(animated(R"([{ "at": 0 }, { "at": 5 }])")),
            "S: objects[0].keys: in a looping scene the keys must begin at 0 and end at 8, the scene's 'loop'");
  EXPECT_EQ(complaint(animated(R"([{ "at": 0 }, { "at": 6 }, { "at": 6 }, { "at": 8 }])")),
            "S: objects[0].keys[2].at: keys must be in order of time, and no two at one time");
  EXPECT_EQ(complaint(animated(R"([{ "translate": [1, 0, 0] }])")), "S: objects[0].keys[0].at: missing");
}

}  // namespace
