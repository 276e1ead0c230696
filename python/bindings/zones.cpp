#include "clearloci/zones.hpp"

#include "bindings/bindings.hpp"
#include "bindings/maps.hpp"
#include "clearloci/export.hpp"

namespace clearloci::python {

void bind_zones(py::module_& module) {
  py::class_<ZoneMap>(module, "ZoneMap", "Discontinuity-free zones as the library holds them.")
      .def("data",
           [](const ZoneMap& map) {
             py::list zones;
             for (const Zone& zone : map.zones) {
               py::list holes;
               for (const Polyline& hole : zone.holes) holes.append(array_of(hole));
               py::dict signs, one;
               for (const auto& [reaction, sign] : zone.signs) signs[py::str(name_of(reaction))] = sign;
               py::list borders;
               for (const ZoneBorder& border : zone.borders)
                 borders.append(py::make_tuple(border.curve, border.length));
               one["id"] = zone.id;
               one["working_mode"] = mode_of(map.loci.tower, zone.mode);
               one["assembly_mode"] = zone.assembly_mode;
               one["signs"] = signs;
               one["area"] = zone.area;
               one["polygon"] = array_of(zone.outer);
               one["holes"] = holes;
               one["inscribed_circle"] = py::make_tuple(
                   py::make_tuple(zone.inscribed.centre[0], zone.inscribed.centre[1]), zone.inscribed.radius);
               one["sample"] = py::make_tuple(zone.sample[0], zone.sample[1]);
               one["borders"] = borders;
               one["certified"] = zone.certified;
               zones.append(one);
             }
             py::list areas;
             for (const ModeArea& area : map.areas) {
               py::dict one;
               one["working_mode"] = mode_of(map.loci.tower, area.mode);
               one["workspace"] = area.workspace;
               one["in_doubt"] = area.in_doubt;
               areas.append(one);
             }
             py::dict all;
             all["zones"] = zones;
             all["areas"] = areas;
             all["loci"] = dict_of(map.loci);
             return all;
           })
      .def("json", [](const ZoneMap& map) { return to_json(map); })
      .def("table", [](const ZoneMap& map) { return to_table(map); })
      .def("svgs",
           [](const ZoneMap& map) {
             std::vector<std::string> pictures;
             for (const WorkingMode& mode : modes_of(map.loci)) pictures.push_back(to_svg(map, mode));
             return pictures;
           })
      .def("export", [](const ZoneMap& map, const Model&, const std::string& folder,
                        const std::set<std::string>& formats) { return names_of(export_zones(map, folder, formats)); });
  module.def("find_zones", [](const Model& model, const py::kwargs& options) {
    LociRequest request = request_of(model, options);
    return unlocked(request, [&](const LociRequest& own) { return find_zones(model, own); });
  });
}

}  // namespace clearloci::python
