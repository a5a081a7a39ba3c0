#include "segment.h"
void celd_segmenter_free (CeldSegmenter *segmenter) { (void) segmenter; }
