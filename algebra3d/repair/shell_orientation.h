#pragma once

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/repair/facet_list.h"
#include "algebra3d/repair/repair_report.h"

namespace algebra3d {

/// Turns shells right side out, largest first: one with a negative volume stays as it is within the ones before it, as
/// a cavity of them (as its largest and its outermost facets tell), and is turned over elsewhere. If the smallest one
/// before it that goes round all of it was turned over, and it looks the other way than that one did, it goes along: a
/// body that is inside out is so with its cavities and what is in them. A shell is what hangs together across edges of
/// two facets, and across edges of more as far as it would have more facets there that run one way than the other:
/// bodies that touch in an edge are shells by themselves. What is not quite closed has the volume of the pyramids over
/// its facets with their tops in the middle of its box. Exact where shells are closed. Errors: interrupted. Cost:
/// linear, and that of all shells before it for each one of negative volume.
Status orient_shells(FacetList& facets, RepairReport& report, const Monitor& monitor = {});

}  // namespace algebra3d
