// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>
#ifdef URDFDOM_TINYXML2
#include <tinyxml2.h>
#else
#include <tinyxml.h>
#endif

namespace cabinet_articulation::core {

/// What urdf::exportURDF returns: TinyXML-2's from urdfdom 4 on, TinyXML's before.
#ifdef URDFDOM_TINYXML2
using UrdfDocument = tinyxml2::XMLDocument;
using UrdfPrinter = tinyxml2::XMLPrinter;
#else
using UrdfDocument = TiXmlDocument;
using UrdfPrinter = TiXmlPrinter;
#endif

}  // namespace cabinet_articulation::core
