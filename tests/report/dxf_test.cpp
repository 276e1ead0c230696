// Held against ezdxf, an independent reader (package python3-ezdxf, which script/bootstrap --tests installs).
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>

#include "report/exports.hpp"
#include "report/files.hpp"
#include "tests/report/five_bar_map.hpp"
#include "tests/report/scratch_folder.hpp"

namespace clearloci::report {
namespace {

using Json = nlohmann::json;

/// What ezdxf reads: version, errors and repairs of its audit, units, layers and, an entity, its main values.
Json read_with_ezdxf(const std::string& bytes) {
  const fixture::ScratchFolder scratch;
  write_atomically(scratch.path() / "loci.dxf", bytes);
  write_atomically(scratch.path() / "read.py", R"py(
import json, math, sys, ezdxf
doc = ezdxf.readfile(sys.argv[1])
audit = doc.audit()
entities = []
for e in doc.modelspace():
    entry = {"type": e.dxftype(), "layer": e.dxf.layer, "remarks": [t.value for t in e.get_xdata("CLEARLOCI")]}
    if e.dxftype() == "LINE":
        entry["points"] = [list(e.dxf.start)[:2], list(e.dxf.end)[:2]]
    elif e.dxftype() == "ARC":
        entry["points"] = [list(e.start_point)[:2], list(e.end_point)[:2]]
    if e.dxftype() in ("ARC", "CIRCLE"):
        entry["centre"], entry["radius"] = list(e.dxf.center)[:2], e.dxf.radius
    if e.dxftype() == "ARC":
        sweep = (e.dxf.end_angle - e.dxf.start_angle) % 360
        entry["length"] = math.radians(sweep) * e.dxf.radius
    if e.dxftype() == "LWPOLYLINE":
        entry["points"], entry["closed"] = [list(p) for p in e.get_points("xy")], e.closed
    if e.dxftype() == "POLYLINE":
        entry["points"], entry["closed"] = [list(p)[:2] for p in e.points()], e.is_closed
    if e.dxftype() == "POINT":
        entry["points"] = [list(e.dxf.location)[:2]]
    entities.append(entry)
print(json.dumps({"version": doc.dxfversion, "errors": [str(x.message) for x in audit.errors],
    "fixes": [str(x.message) for x in audit.fixes], "units": doc.header["$INSUNITS"],
    "layers": {l.dxf.name: [l.dxf.color, l.dxf.linetype] for l in doc.layers},
    "line_types": [t.dxf.name for t in doc.linetypes], "entities": entities}))
)py");
  const std::string command = "/usr/bin/python3 '" + (scratch.path() / "read.py").string() + "' '" +
                              (scratch.path() / "loci.dxf").string() + "' > '" +
                              (scratch.path() / "out.json").string() + "'";
  EXPECT_TRUE(fixture::succeeds(command)) << "ezdxf could not read the file; is python3-ezdxf installed?";
  return Json::parse(fixture::read_file(scratch.path() / "out.json"));
}

Json of_type(const Json& read, const std::string& type) {
  Json found = Json::array();
  for (const auto& entity : read["entities"]) {
    if (entity["type"] == type) found.push_back(entity);
  }
  return found;
}

void expect_near(const Json& point, const core::Point2& expected) {
  EXPECT_NEAR(point[0].get<double>(), expected[0], 1e-9);
  EXPECT_NEAR(point[1].get<double>(), expected[1], 1e-9);
}

class DxfVersions : public ::testing::TestWithParam<DxfVersion> {};
INSTANTIATE_TEST_SUITE_P(Dxf, DxfVersions, ::testing::Values(DxfVersion::r2000, DxfVersion::r12));

TEST_P(DxfVersions, PassesTheAuditAndDeclaresWhatItUses) {
  const bool modern = GetParam() == DxfVersion::r2000;
  for (const auto& map : {fixture::five_bar_map(), fixture::five_bar_map_in_all_modes(), fixture::hostile_map()}) {
    const Json read = read_with_ezdxf(dxf(map, GetParam()));
    EXPECT_EQ(read["errors"], Json::array());
    EXPECT_EQ(read["fixes"], Json::array());
    EXPECT_EQ(read["version"], modern ? "AC1015" : "AC1009");
    EXPECT_EQ(read["units"], 6);
    for (const auto& entity : read["entities"]) {
      ASSERT_TRUE(read["layers"].contains(entity["layer"].get<std::string>())) << entity;
    }
    for (const auto& layer : read["layers"]) {
      const auto names = read["line_types"].get<std::vector<std::string>>();
      EXPECT_TRUE(std::any_of(names.begin(), names.end(), [&](std::string name) {
        std::transform(name.begin(), name.end(), name.begin(), ::toupper);
        std::string wanted = layer[1].get<std::string>();
        std::transform(wanted.begin(), wanted.end(), wanted.begin(), ::toupper);
        return name == wanted;
      })) << layer;
    }
  }
}

TEST_P(DxfVersions, EveryArcIsOneEntityOfItsTrueShape) {
  const auto map = fixture::hostile_map();
  const Json read = read_with_ezdxf(dxf(map, GetParam()));
  std::size_t index = 0;
  for (const auto& curve : map.curves) {
    for (const auto& arc : curve.arcs) {
      const Json& entity = read["entities"][index++];
      if (const auto* circle = std::get_if<core::CircleForm>(&curve.closed_form)) {
        ASSERT_EQ(entity["type"], arc.closed ? "CIRCLE" : "ARC");
        expect_near(entity["centre"], {core::to_double(circle->centre[0]), core::to_double(circle->centre[1])});
        EXPECT_NEAR(entity["radius"].get<double>(), std::sqrt(core::to_double(circle->radius_squared)), 1e-12);
        if (arc.closed) continue;
        // The same part of the circle: the ends, in either order, and the length along it.
        const bool same_order = std::abs(entity["points"][0][0].get<double>() - arc.points.front()[0]) < 1e-9 &&
                                std::abs(entity["points"][0][1].get<double>() - arc.points.front()[1]) < 1e-9;
        expect_near(entity["points"][same_order ? 0 : 1], arc.points.front());
        expect_near(entity["points"][same_order ? 1 : 0], arc.points.back());
        EXPECT_NEAR(entity["length"].get<double>(), arc.length, 1e-4 * arc.length);
      } else if (std::holds_alternative<core::LineForm>(curve.closed_form)) {
        ASSERT_EQ(entity["type"], "LINE");
        expect_near(entity["points"][0], arc.points.front());
        expect_near(entity["points"][1], arc.points.back());
      } else {
        ASSERT_EQ(entity["type"], GetParam() == DxfVersion::r2000 ? "LWPOLYLINE" : "POLYLINE");
        EXPECT_EQ(entity["closed"].get<bool>(), arc.closed);
        ASSERT_EQ(entity["points"].size(), arc.points.size() - (arc.closed ? 1 : 0));
        for (std::size_t i = 0; i < entity["points"].size(); ++i) expect_near(entity["points"][i], arc.points[i]);
      }
    }
  }
  EXPECT_EQ(of_type(read, "POINT").size(), map.isolated_points.size());
}

/// ARC runs counter-clockwise; a polyline that runs clockwise is the same part of the circle.
TEST(Dxf, AnArcTurnedAroundIsTheSameArc) {
  core::LocusMap map = fixture::five_bar_map();
  map.curves.resize(1);
  const Json there = read_with_ezdxf(dxf(map))["entities"][0];
  std::reverse(map.curves[0].arcs[0].points.begin(), map.curves[0].arcs[0].points.end());
  const Json back = read_with_ezdxf(dxf(map))["entities"][0];
  expect_near(back["points"][0], there["points"][0].get<core::Point2>());
  EXPECT_NEAR(back["length"].get<double>(), there["length"].get<double>(), 1e-9);
}

TEST(Dxf, LayersNameCurveAndKind) {
  const Json layers = read_with_ezdxf(dxf(fixture::five_bar_map()))["layers"];
  EXPECT_TRUE(layers.contains("c1-contact-loss"));
  EXPECT_EQ(layers["c5-direct-singularity"][1], "DASHDOT");
  EXPECT_EQ(layers["c6-backlash"][1], "DASHED");
  EXPECT_TRUE(layers.contains("c7-workspace-boundary"));
  EXPECT_TRUE(layers.contains("isolated-contact-loss"));
  EXPECT_EQ(layers["c1-contact-loss"][0], layers["c2-contact-loss"][0]) << "one reason, one colour";
  EXPECT_NE(layers["c1-contact-loss"][0], layers["c3-contact-loss"][0]);
}

TEST(Dxf, EntitiesSayTheirModeAndWhatVanishes) {
  const Json read = read_with_ezdxf(dxf(fixture::hostile_map()));
  const auto remarks = read["entities"][0]["remarks"].get<std::vector<std::string>>();
  EXPECT_EQ(remarks[0], "mode: B<1>,\" right, B2 left");
  EXPECT_EQ(remarks[1].substr(0, 25), "vanishing: f_A\"<1>, &A1 f");
  EXPECT_EQ(remarks.back().substr(0, 7), "cause: ");
}

}  // namespace
}  // namespace clearloci::report
