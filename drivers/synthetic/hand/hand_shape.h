#pragma once

#include "drivers/synthetic/hand/hand_mesh.h"

namespace barehand::synthetic {

/// Shape of a simulated hand: factors on the dimensions of the hand mesh in its file. (Unrelated to
/// barehand::HandShape.)
struct HandShape {
  double scale = 1;
  double thickness = 1;
  double thumb = 1, index = 1, middle = 1, ring = 1, little = 1;
};
template <class V>
void visit(V& v, HandShape& p) {
  v("scale", p.scale, 0.6, 1.5, "size of the hand; 1: as in its file");
  v("thickness", p.thickness, 0.7, 1.4, "factor on the thickness of fingers and palm");
  v("thumb", p.thumb, 0.7, 1.4, "factor on the thumb's length");
  v("index", p.index, 0.7, 1.4, "factor on the index finger's length");
  v("middle", p.middle, 0.7, 1.4, "factor on the middle finger's length");
  v("ring", p.ring, 0.7, 1.4, "factor on the ring finger's length");
  v("little", p.little, 0.7, 1.4, "factor on the little finger's length");
}

/// Changes the shape of a rigged hand: the joints move along the bones, and the skin follows them by its weights.
HandMesh reshaped(const HandMesh& mesh, const HandShape& shape);

}  // namespace barehand::synthetic
