// The fields of a request as what the library is asked: the mechanism, its working mode, which loci.
#pragma once

#include "clearloci/loci.hpp"
#include "clearloci/mechanism.hpp"
#include "workbench/server/fields.hpp"

namespace clearloci::workbench {

/// `file`: what the text is called in messages, which name it at every place of the document.
std::string file_of(const Fields& fields);

/// `text`, `file`: the mechanism of the request.
Model model_of(const Fields& fields);

/// `mode`: +1 or -1 for each dyad and slider; empty: the file's.
DyadSides sides_of(const Fields& fields);

/// `joints`, `quantities`, `mode`, `all_modes`, `min_force`, `min_couple`, `tolerance` (a part of the box),
/// `mesh_size`.
LociRequest loci_request(const Fields& fields, const Model& model);

}  // namespace clearloci::workbench
