#include "core/locus_map.hpp"

#include "core/errors.hpp"

namespace clearloci::inline core {

std::string to_string(LocusKind kind) {
  switch (kind) {
    case LocusKind::contact_loss:
      return "contact-loss";
    case LocusKind::backlash:
      return "backlash";
    case LocusKind::component:
      return "component";
    case LocusKind::margin:
      return "margin";
    case LocusKind::preload:
      return "preload";
    case LocusKind::direct_singularity:
      return "direct-singularity";
    case LocusKind::workspace_boundary:
      return "workspace-boundary";
    case LocusKind::no_limit:
      return "no-limit";
  }
  return {};
}

std::string to_string(ArcEnd end) {
  switch (end) {
    case ArcEnd::none:
      return "none";
    case ArcEnd::boundary:
      return "boundary";
    case ArcEnd::direct_singularity:
      return "direct-singularity";
    case ArcEnd::box:
      return "box";
    case ArcEnd::crossing:
      return "crossing";
  }
  return {};
}

bool is_open_place_of(const OpenRegion& region, const LocusCurve& curve) {
  return !region.point && region.mode == curve.mode && region.kind == curve.kind && region.factor == curve.factor;
}

std::string to_string(Engine engine) {
  switch (engine) {
    case Engine::adaptive_then_exact:
      return "adaptive-then-exact";
    case Engine::exact:
      return "exact";
    case Engine::adaptive:
      break;
  }
  return "adaptive";
}

std::optional<Engine> engine_named(std::string_view name) {
  if (name == "automatic") return Engine::adaptive_then_exact;
  for (const Engine engine : {Engine::adaptive_then_exact, Engine::exact, Engine::adaptive})
    if (name == to_string(engine)) return engine;
  return std::nullopt;
}

}  // namespace clearloci::inline core
