/* Made by write-strings.c from tables of settings and operations. */
/* ink, label */
N_("Ink")
/* ink, choice */
N_("Automatic")
/* ink, choice */
N_("Dark lines")
/* ink, choice */
N_("Light lines")
/* ink, choice */
N_("Opaque pixels")
/* ink, choice */
N_("Lines of a coloured drawing")
/* ink, help */
N_("What counts as ink in the drawing. Lines may be darker than the paper, lighter than the paper (chalk), or whatever is opaque on a transparent layer. In a coloured drawing they are what is darker, or lighter, than the fills on both sides of it")
/* ink-threshold, label */
N_("Ink threshold")
/* ink-threshold, help */
N_("Ink at or below this value counts as fully inked (0 is ink, 1 is paper). Raise it if depth leaks through pale contours")
/* method, label */
N_("Method")
/* method, choice */
N_("Basins")
/* method, choice */
N_("Exact")
/* method, choice */
N_("Random walker")
/* method, help */
N_("How the regions are found. 'basins' works on the basins of the drawing and keeps up with the brush; 'exact' cuts between all pixels and 'walker' is a random walker, which both take a second or more")
/* close-gaps, label */
N_("Close gaps")
/* close-gaps, help */
N_("Closes gaps in contours from line end to line end, as a person would draw them")
/* keep-necks, label */
N_("Keep necks")
/* keep-necks, help */
N_("Lets a part keep the one colour scribbled in it, however narrow its neck. Otherwise the shorter boundary wins")
/* hardness, label */
N_("Hardness")
/* hardness, help */
N_("How strictly scribbles are obeyed. Soft scribbles may be sloppy, because the majority of the paint wins; at 1 every painted pixel is obeyed")
/* flats, label */
N_("Scribbles are flat colours")
/* flats, help */
N_("The scribbles layer is a finished flat colouring, in which each colour is a region. Without that layer a coloured drawing is its own")
/* background, label */
N_("Background")
/* background, choice */
N_("Along the frame")
/* background, choice */
N_("None")
/* background, choice */
N_("By colour")
/* background, help */
N_("Which region lies behind all others. It can be the one along the frame, none, or the one scribbled in the background colour")
/* background-colour, label */
N_("Background colour")
/* background-colour, help */
N_("The scribble colour of the background")
/* seeds, label */
N_("Regions from arrows")
/* seeds, choice */
N_("Where there is no scribble")
/* seeds, choice */
N_("Never")
/* seeds, help */
N_("Whether the end of an arrow makes a region of its own where there is no scribble")
/* same-colour, label */
N_("Same colour")
/* same-colour, choice */
N_("One depth")
/* same-colour, choice */
N_("Separate depths")
/* same-colour, help */
N_("Whether all regions of one colour share one depth, or each has a depth of its own")
/* arrow-style, label */
N_("Arrow style")
/* arrow-style, choice */
N_("The arrowhead points at the farther part")
/* arrow-style, choice */
N_("A dot marks the nearer end")
/* arrow-style, choice */
N_("The opaque end is nearer")
/* arrow-style, choice */
N_("The thick end is nearer")
/* arrow-style, help */
N_("How a painted arrow shows which of its ends is nearer")
/* on-cycle, label */
N_("Contradictions")
/* on-cycle, choice */
N_("Leave out lighter and later relations")
/* on-cycle, choice */
N_("Leave out the smallest total weight")
/* on-cycle, choice */
N_("Split regions, so that they bend")
/* on-cycle, help */
N_("What gives way when relations contradict each other. 'report' leaves out lighter and later relations one by one, 'drop-weakest' those with the smallest total weight. 'split' splits regions where that is cheapest, so that they bend; only Pop-up can do that, other operations then act as with 'drop-weakest'. Whatever is left out or split is reported")
/* suggest, label */
N_("Suggestions")
/* suggest, choice */
N_("Off")
/* suggest, choice */
N_("Where arrows leave it open")
/* suggest, choice */
N_("All")
/* suggest, help */
N_("Whether the order may also follow from the drawing itself, by its T-junctions and shapes. This can be never, only where arrows and relations leave the order open, or everywhere; arrows and relations always take precedence")
/* encoding, label */
N_("Encoding")
/* encoding, choice */
N_("From 0 to 1")
/* encoding, choice */
N_("Ranks")
/* encoding, choice */
N_("Fixed scale")
/* encoding, help */
N_("How levels become numbers. They run from 0 to 1, are ranks (0, 1, 2, ...), or lie on a fixed scale that does not change with a new arrow")
/* near-level, label */
N_("Near level")
/* near-level, help */
N_("The level that becomes 1; it must be above the far level")
/* far-level, label */
N_("Far level")
/* far-level, help */
N_("The level that becomes 0; it must be below the near level")
/* expansion, label */
N_("Contour ownership")
/* expansion, choice */
N_("Outlines")
/* expansion, choice */
N_("Thickness of contours")
/* expansion, help */
N_("How contours are given to the part that they belong to. 'outlines' follows the outline that one pen drew around each part, in front of what is behind it; 'thickness' goes by the local thickness of the contours, as in the paper")
/* complete, label */
N_("Complete")
/* complete, help */
N_("Draws in layers also what nearer layers hide")
/* margin, label */
N_("Margin")
/* margin, help */
N_("How far each part goes on under nearer ones at least, as a fraction of the width, so that views and models show no cracks")
/* anchors, label */
N_("Anchors")
/* anchors, choice */
N_("Scribbles")
/* anchors, choice */
N_("Ends of arrows")
/* anchors, choice */
N_("Scribbles and arrows")
/* anchors, choice */
N_("The core of each region")
/* anchors, help */
N_("Which pixels keep their level in smooth depth")
/* hold-rest, label */
N_("Hold the rest")
/* hold-rest, help */
N_("Regions without an anchor keep their level in their core. Otherwise they take the depth that flows in through gaps in their contours")
/* hold-gaps, label */
N_("Hold at gaps")
/* hold-gaps, help */
N_("Depth changes abruptly, and shading ends, also where a contour between two levels is broken, for up to about seven stroke widths. Wider openings, and blue virtual contours, stay smooth; without it every gap is smooth, as in the paper")
/* tolerance, label */
N_("Tolerance")
/* tolerance, help */
N_("The largest error of smooth depth, as a fraction of its range")
/* contrast, label */
N_("Contrast")
/* contrast, help */
N_("How large a step of the ink must be to separate depths, as a factor of the mean step in the drawing. At smaller values pale lines separate depths too; at larger ones depth leaks through them")
/* weight-floor, label */
N_("Weight floor")
/* weight-floor, help */
N_("How strongly neighbouring pixels are linked at least, even across the blackest line")
/* bulge, label */
N_("Bulge")
/* bulge, help */
N_("How round the parts look: flat at 0, like balls at 1")
/* bevel, label */
N_("Bevel")
/* bevel, help */
N_("How wide the rounded edge of each part is, as a fraction of the picture's diagonal. The inside is flat; at 0 parts are round all over")
/* creases, label */
N_("Creases")
/* creases, help */
N_("How much parts bend at strokes inside them, such as wrinkles and folds. They bend on both sides of a stroke, or on the higher side where smooth depth is given")
/* frame-outline, label */
N_("Frame is an outline")
/* frame-outline, help */
N_("Parts that are cut off by the frame of the picture bend there, too")
/* light-model, label */
N_("Shading")
/* light-model, choice */
N_("Soft")
/* light-model, choice */
N_("Softer")
/* light-model, choice */
N_("In steps")
/* light-model, choice */
N_("Like a lit ball")
/* light-model, help */
N_("How surfaces are lit. Light is soft, softer so that it reaches around the parts, in steps, or taken from the picture of a lit ball (matcap)")
/* toon-steps, label */
N_("Steps")
/* toon-steps, help */
N_("The number of steps in toon shading, from darkness to the light on what faces the viewer")
/* light-background, label */
N_("Light on the background")
/* light-background, help */
N_("Whether the background takes light, too. It is the farthest level, if that has half of the picture's frame or more")
/* light, label */
N_("Light")
/* light, choice */
N_("From far away")
/* light, choice */
N_("From a point")
/* light, help */
N_("Whether the light comes from far away, or from a point in front of the picture")
/* light-azimuth, label */
N_("Light azimuth")
/* light-azimuth, help */
N_("Where the light comes from, in degrees: 0 from the right, 90 from above, 180 from the left")
/* light-elevation, label */
N_("Light elevation")
/* light-elevation, help */
N_("How high the light stands, in degrees: 0 beside the picture, 90 in front of it")
/* ambient, label */
N_("Ambient light")
/* ambient, help */
N_("The fraction of the light that reaches every pixel")
/* light-x, label */
N_("Light X")
/* light-x, help */
N_("Where the point light is: 0 at the left edge, 1 at the right edge")
/* light-y, label */
N_("Light Y")
/* light-y, help */
N_("Where the point light is: 0 at the upper edge, 1 at the lower edge")
/* light-height, label */
N_("Light height")
/* light-height, help */
N_("How far in front of the picture the point light is, as a fraction of the picture's diagonal")
/* specular, label */
N_("Highlights")
/* specular, help */
N_("How bright highlights are")
/* shininess, label */
N_("Shininess")
/* shininess, help */
N_("How small highlights are")
/* rim-light, label */
N_("Rim light")
/* rim-light, help */
N_("How bright the rims are, where parts turn away from the viewer")
/* rim-power, label */
N_("Rim narrowness")
/* rim-power, help */
N_("How narrow the rims are")
/* enhance, choice */
N_("Shadows on what is behind")
/* enhance, choice */
N_("Darker behind depth boundaries")
/* enhance, choice */
N_("Also lighter in front of them")
/* enhance, help */
N_("How depth is emphasized. Parts cast soft shadows on those behind them, or depth is sharpened: darker behind a depth boundary, or also lighter in front of it")
/* shadow-size, label */
N_("Size")
/* shadow-size, help */
N_("How far shadows spread, as a fraction of the picture's diagonal")
/* shadow-strength, label */
N_("Strength")
/* shadow-strength, help */
N_("How dark shadows are, from 0 (none) to 1 (black)")
/* shadow-offset, label */
N_("Offset")
/* shadow-offset, help */
N_("How far shadows are shifted away from the light, as a fraction of the picture's diagonal")
/* shadow-range, label */
N_("Full from")
/* shadow-range, help */
N_("The difference of depth from which shadows have full strength, as a fraction of all depth. Smaller differences give fainter shadows; at 0 all shadows are full")
/* stereo, label */
N_("Arrangement")
/* stereo, choice */
N_("Left view")
/* stereo, choice */
N_("Right view")
/* stereo, choice */
N_("Side by side")
/* stereo, choice */
N_("Side by side, half width")
/* stereo, choice */
N_("Side by side, for crossed eyes")
/* stereo, choice */
N_("One above the other")
/* stereo, choice */
N_("One above the other, half height")
/* stereo, choice */
N_("Alternating rows")
/* stereo, choice */
N_("Alternating columns")
/* stereo, choice */
N_("Red and cyan glasses, grey")
/* stereo, choice */
N_("Red and cyan glasses, colour")
/* stereo, choice */
N_("Red and cyan glasses, half colour")
/* stereo, choice */
N_("Red and cyan glasses, Dubois")
/* stereo, help */
N_("How the two views are combined in one picture. They are mixed for red and cyan glasses, placed beside or above each other, or alternate by rows or columns for a screen that separates them; or there is only one view. Whole views beside or above each other make the picture larger")
/* disparity, label */
N_("Disparity")
/* disparity, help */
N_("How far the nearest and the farthest depth are displaced between the views, as a fraction of the width. More than 0.033 strains the eyes")
/* convergence, label */
N_("Convergence")
/* convergence, help */
N_("Which depth lies on the screen. At 0 it is the farthest, so that everything else stands out in front of the screen; at 1 it is the nearest, so that everything else lies behind it")
/* floating-window, label */
N_("Floating window")
/* floating-window, help */
N_("Adds black bars at the sides where the frame cuts off something in front of the screen. They bring the frame in front of it")
/* screen-width, label */
N_("Screen width")
/* screen-width, help */
N_("How wide the picture will be shown, in mm, to warn where the eyes would have to turn outwards; 0 gives no warning")
/* path, label */
N_("Path")
/* path, choice */
N_("From side to side")
/* path, choice */
N_("In a circle")
/* path, choice */
N_("As if the drawing turned")
/* path, help */
N_("How the camera moves")
/* relief-from, label */
N_("Round from")
/* relief-from, choice */
N_("Inflation")
/* relief-from, choice */
N_("Normals")
/* relief-from, help */
N_("Whether parts bulge as if inflated, or follow their normals")
/* relief-bulge, help */
N_("How round the parts are: flat at 0, discs become hemispheres at 1")
/* relief-depth, label */
N_("Depth")
/* relief-depth, help */
N_("How far the nearest level stands in front of the farthest, as a fraction of the picture's diagonal")
/* mesh-kind, label */
N_("Mesh")
/* mesh-kind, choice */
N_("Parts, solid for STL")
/* mesh-kind, choice */
N_("Surfaces of parts")
/* mesh-kind, choice */
N_("Solid parts, on a plate")
/* mesh-kind, choice */
N_("One surface")
/* mesh-kind, help */
N_("Whether each part is a surface of its own, or a closed solid on a plate, or all of the picture is one surface with cracks where depth jumps. 'auto' makes solids for STL files only")
/* mesh-size, help */
N_("The length of the picture's longer side, in mm")
/* mesh-plate, label */
N_("Plate")
/* mesh-plate, help */
N_("The thickness of the plate under solids, in mm")
/* mesh-error, label */
N_("Error")
/* mesh-error, help */
N_("How far the mesh may lie from the heights, in pixels")
/* most-vertices, label */
N_("Vertices")
/* most-vertices, help */
N_("The largest number of vertices. The mesh becomes coarser rather than have more")
/* cell-size, label */
N_("Cell size")
/* cell-size, help */
N_("The side of the squares that a drawing is embedded into, in pixels; 0 chooses one by the size of the picture. Smaller squares follow smaller bends")
/* stiffness, label */
N_("Stiffness")
/* stiffness, help */
N_("How rigid parts are. Stiffer parts bend less where lines of the two drawings differ")
/* celdepth:virtual-contours, title */
N_("Virtual Contours")
/* celdepth:virtual-contours, description */
N_("Adds painted contours to a line drawing: boundaries that the artist left out, and ink that is not a boundary")
/* celdepth:virtual-contours, layer */
N_("Drawing")
/* celdepth:virtual-contours, help of a layer */
N_("The line drawing")
/* celdepth:virtual-contours, layer */
N_("Contours")
/* celdepth:virtual-contours, help of a layer */
N_("Red: a boundary of regions and depth; blue: a boundary of regions across which depth stays smooth; green: ink that is not a boundary")
/* celdepth:virtual-contours, label */
N_("Result")
/* celdepth:virtual-contours, choice */
N_("For segmentation")
/* celdepth:virtual-contours, choice */
N_("For depth")
/* celdepth:virtual-contours, help */
N_("The drawing with contours for segmentation, or for depth: blue contours are in the former only")
/* celdepth:lazybrush-segment, title */
N_("Lazybrush Segment")
/* celdepth:lazybrush-segment, description */
N_("Finds the parts of a line drawing from a few sloppy strokes, and fills each part with the colour of its stroke")
/* celdepth:lazybrush-segment, help of a layer */
N_("One stroke over each part, in a colour of its own")
/* celdepth:lazybrush-segment, layer */
N_("Arrows")
/* celdepth:lazybrush-segment, help of a layer */
N_("Arrows that point from nearer to farther parts. Their ends are seeds for parts without a stroke")
/* celdepth:lazybrush-segment, choice */
N_("Labels: the regions as flat colours")
/* celdepth:lazybrush-segment, choice */
N_("Closures: gaps in contours that were closed, in red")
/* celdepth:lazybrush-segment, choice */
N_("Problems: marks on the drawing")
/* celdepth:lazybrush-segment, help */
N_("The regions, a layer of the gaps that were closed, or the drawing with a mark where something needs attention")
/* celdepth:lazybrush-segment, label */
N_("More settings")
/* celdepth:lazybrush-segment, help */
N_("Shows settings that are rarely needed. The result stays the same")
/* celdepth:lazybrush-segment, label */
N_("Relations")
/* celdepth:lazybrush-segment, help */
N_("Relations between parts: '120,80 > 300,95' says that the part at the first point is nearer than the part at the second, '#ff0000 > #00ff00' compares the parts of two colours, and '=' means equal depth. Write one relation per line, or separate them by ';'")
/* celdepth:lazybrush-segment, label */
N_("Arrow path")
/* celdepth:lazybrush-segment, help */
N_("Arrows as SVG path data, each from the nearer to the farther part, such as 'M 120,80 L 300,95'")
/* celdepth:depth-order, title */
N_("Depth Order")
/* celdepth:depth-order, description */
N_("Gives each region a depth level, by arrows and relations that tell which region is in front of which")
/* celdepth:depth-order, layer */
N_("Labels")
/* celdepth:depth-order, help of a layer */
N_("The regions as flat colours, from Lazybrush Segment or painted")
/* celdepth:depth-order, help of a layer */
N_("Arrows that point from nearer to farther parts")
/* celdepth:depth-order, help of a layer */
N_("The line drawing. A point on its ink stands for the region beside it, and suggestions come from it")
/* celdepth:depth-order, layer */
N_("Depth hint")
/* celdepth:depth-order, help of a layer */
N_("Depth from another source, such as an estimator, where nearer is brighter. Suggestions come from it, too")
/* celdepth:depth-expand, title */
N_("Depth Expand")
/* celdepth:depth-expand, description */
N_("Gives each contour to the part that it outlines, so that depth levels change at the outer edge of the ink")
/* celdepth:depth-expand, layer */
N_("Levels")
/* celdepth:depth-expand, help of a layer */
N_("The depth levels of the regions from Depth Order")
/* celdepth:depth-expand, layer */
N_("Regions")
/* celdepth:depth-expand, help of a layer */
N_("Flat colours that distinguish regions of the same level. Without this layer each level is one region")
/* celdepth:depth-expand, layer */
N_("Corrections")
/* celdepth:depth-expand, help of a layer */
N_("Strokes over ink, each of which gives the piece of line below it to the region of its colour")
/* celdepth:depth-expand, choice */
N_("Levels, with contours given to their regions")
/* celdepth:depth-expand, choice */
N_("Layer: one layer of the drawing")
/* celdepth:depth-expand, choice */
N_("Matte: the region of each pixel, and its coverage")
/* celdepth:depth-expand, help */
N_("The levels; one layer of the drawing (in linear light); or the region that owns each pixel, in its colour (without a layer of regions as a grey level) and with its coverage of the pixel as opacity")
/* celdepth:depth-expand, label */
N_("Layer")
/* celdepth:depth-expand, help */
N_("The number of the layer: 0 is the farthest. Layers after the nearest are empty. Together, in this order, the layers are the drawing again")
/* celdepth:depth-smooth, title */
N_("Depth Smooth")
/* celdepth:depth-smooth, description */
N_("Turns depth levels into smooth depth, which changes abruptly at ink and across gaps in it, and gradually where contours are open")
/* celdepth:depth-smooth, help of a layer */
N_("Depth levels from Depth Expand or Depth Order")
/* celdepth:depth-smooth, help of a layer */
N_("Painted pixels, for example scribbles, keep their level. Without this layer the pixels deep inside each region do")
/* celdepth:depth-smooth, layer */
N_("Drawing for segmentation")
/* celdepth:depth-smooth, help of a layer */
N_("The drawing with virtual contours for segmentation: depth stays smooth where only this one has ink")
/* celdepth:depth-exact, title */
N_("Depth Exact")
/* celdepth:depth-exact, description */
N_("Finds the smoothest depth for a line drawing that satisfies every relation exactly and changes at contours. Takes a second or more per megapixel, but responds quickly to each further arrow")
/* celdepth:depth-exact, help of a layer */
N_("One stroke over each part, in a colour of its own. All of a stroke gets one depth")
/* celdepth:depth-exact, layer */
N_("Virtual contours")
/* celdepth:depth-exact, help of a layer */
N_("Red: depth changes abruptly; green: ink across which depth stays smooth")
/* celdepth:lumo-shade, title */
N_("Lumo Shade")
/* celdepth:lumo-shade, description */
N_("Shades a drawing as if its parts were round, also where nearer ones hide some of them")
/* celdepth:lumo-shade, help of a layer */
N_("Expanded depth levels from Depth Expand")
/* celdepth:lumo-shade, layer */
N_("Colour art")
/* celdepth:lumo-shade, help of a layer */
N_("The picture to light; the drawing by default")
/* celdepth:lumo-shade, layer */
N_("Smooth depth")
/* celdepth:lumo-shade, help of a layer */
N_("Smooth depth from Depth Smooth, which tells the nearer side of strokes inside a part")
/* celdepth:lumo-shade, layer */
N_("Hints")
/* celdepth:lumo-shade, help of a layer */
N_("Paint beside lines: parts bend on a white side, do not bend on a black side, and bend on both sides at grey")
/* celdepth:lumo-shade, layer */
N_("Matcap")
/* celdepth:lumo-shade, help of a layer */
N_("The picture of a lit ball, from which parts take their shading")
/* celdepth:lumo-shade, help of a layer */
N_("The drawing with virtual contours for segmentation: shading goes on where only this one has ink")
/* celdepth:lumo-shade, choice */
N_("Shaded art")
/* celdepth:lumo-shade, choice */
N_("Tone: a layer to multiply the art by")
/* celdepth:lumo-shade, choice */
N_("Rim: a layer of highlights and rims")
/* celdepth:lumo-shade, choice */
N_("Occlusion")
/* celdepth:lumo-shade, help */
N_("The lit art; the light alone (linear); the normals as 0.5 + 0.5 n (numbers, not colours); a layer to multiply the art by; a layer of highlights to put over the product; or ambient occlusion, the fraction of light that nearer parts let through (numbers)")
/* celdepth:lumo-shade, label */
N_("Occlusion size")
/* celdepth:lumo-shade, help */
N_("How far nearer parts block light from those behind them, as a fraction of the picture's diagonal")
/* celdepth:lumo-shade, label */
N_("Occlusion strength")
/* celdepth:lumo-shade, help */
N_("The largest fraction of light that nearer parts block")
/* celdepth:lumo-shade, label */
N_("DirectX normals")
/* celdepth:lumo-shade, help */
N_("Green points down, as in DirectX, instead of up, as in OpenGL")
/* celdepth:depth-enhance, title */
N_("Depth Enhance")
/* celdepth:depth-enhance, description */
N_("Makes the parts of a picture stand out from those behind them, with soft shadows")
/* celdepth:depth-enhance, layer */
N_("Art")
/* celdepth:depth-enhance, help of a layer */
N_("The picture to enhance")
/* celdepth:depth-enhance, help of a layer */
N_("Expanded depth levels from Depth Expand, or smooth depth for sharpening")
/* celdepth:depth-enhance, choice */
N_("Shadow layer only")
/* celdepth:depth-enhance, choice */
N_("View of depth")
/* celdepth:depth-enhance, help */
N_("The art with shadows, the shadows alone as a black layer to put over the art, or a grey picture that shows depth")
/* celdepth:relief, title */
N_("Relief")
/* celdepth:relief, description */
N_("Turns the parts of a drawing into rounded heights, each in front of what is behind it")
/* celdepth:relief, help of a layer */
N_("Smooth depth from Depth Smooth; by default it is computed from the levels")
/* celdepth:relief, help of a layer */
N_("The drawing with virtual contours for segmentation: the surface goes on where only this one has ink")
/* celdepth:relief, label */
N_("Heights")
/* celdepth:relief, choice */
N_("In pixels")
/* celdepth:relief, help */
N_("Heights from 0, the lowest, to 1, the highest; or heights in pixels, with depth 0 at height 0")
/* celdepth:stereo, title */
N_("Stereo")
/* celdepth:stereo, description */
N_("Turns a picture with depth into a stereo picture, with a view for each eye")
/* celdepth:stereo, help of a layer */
N_("The picture to show")
/* celdepth:stereo, help of a layer */
N_("Smooth depth, where nearer is brighter")
/* celdepth:stereo, help of a layer */
N_("Depth levels, by which the picture is cut into completed layers. Without them the parts that come into view are filled from what is behind")
/* celdepth:stereo, help of a layer */
N_("The line drawing, to distinguish ink from paint in coloured art")
/* celdepth:arap-register, title */
N_("Register Drawings")
/* celdepth:arap-register, description */
N_("Finds where each part of a drawing is in another one, such as the next frame of an animation")
/* celdepth:arap-register, help of a layer */
N_("The drawing whose parts move")
/* celdepth:arap-register, layer */
N_("Target")
/* celdepth:arap-register, help of a layer */
N_("The drawing to register it to, such as the next frame")
/* celdepth:arap-register, help of a layer */
N_("Depth levels of the first drawing: parts of different levels move on their own")
/* celdepth:arap-register, choice */
N_("Displacement: how far each pixel moves")
/* celdepth:arap-register, choice */
N_("Warped: the drawing, moved to the other one")
/* celdepth:arap-register, choice */
N_("Confidence: how well lines fit")
/* celdepth:arap-register, help */
N_("How many pixels each pixel moves to the right (red) and down (green); the drawing, moved to where the other one has it, on a transparent ground; or how well the lines around each pixel fit, from 0 to 1")
/* celdepth:depth-propagate, title */
N_("Depth Propagate")
/* celdepth:depth-propagate, description */
N_("Finds the regions and depth levels of the next frame of an animation from those of the frame before")
/* celdepth:depth-propagate, help of a layer */
N_("The drawing to find regions for, such as the next frame")
/* celdepth:depth-propagate, layer */
N_("Drawing before")
/* celdepth:depth-propagate, help of a layer */
N_("The drawing whose regions are known, such as the frame before")
/* celdepth:depth-propagate, help of a layer */
N_("One stroke over each part of the drawing before, in a colour of its own; or its regions as flat colours")
/* celdepth:depth-propagate, help of a layer */
N_("The expanded depth levels of the drawing before. They take the place of arrows and relations, and regions keep them")
/* celdepth:depth-propagate, help of a layer */
N_("Arrows over the drawing before that point from nearer to farther parts")
/* celdepth:depth-propagate, choice */
N_("Scribbles: the colours of regions, off the lines")
/* celdepth:depth-propagate, choice */
N_("Depth: smooth")
/* celdepth:depth-propagate, choice */
N_("Confidence: how well moved parts and regions agree")
/* celdepth:depth-propagate, help */
N_("The regions of the drawing, in the colours that they have in the frame before; the same as scribbles, which you can correct; its levels or smooth depth; or how well the parts that were moved and the regions agree, from 0 to 1")
/* celdepth:depth-propagate, label */
N_("Scribbles are regions")
/* celdepth:depth-propagate, help */
N_("The layer of scribbles has the regions of the frame before as flat colours, such as the labels that this operation made for it")
/* celdepth:arap-deform, title */
N_("Deform")
/* celdepth:arap-deform, description */
N_("Moves parts of a drawing by handles, in front of others or behind them. Takes a second or more per megapixel, but responds quickly to each further handle")
/* celdepth:arap-deform, help of a layer */
N_("The picture to deform")
/* celdepth:arap-deform, help of a layer */
N_("The expanded depth levels of the art, by which it is cut into parts. Without them its parts come from scribbles and arrows")
/* celdepth:arap-deform, layer */
N_("Handles")
/* celdepth:arap-deform, help of a layer */
N_("Handles: an arrow from a place to where it is taken, a dot on a place that stays")
/* celdepth:arap-deform, help */
N_("The deformed picture, or its depth levels")
/* celdepth:arap-deform, help */
N_("Places of the picture: '120,80 -> 200,60' takes the first place to the second, '300,400' stays where it is, and '^1' after a handle moves what is near it forward by one level, '^-1' back. Write one handle per line, or separate them by ';'")
/* celdepth:compose, title */
N_("Compose")
/* celdepth:compose, description */
N_("Puts a picture behind the near parts of another one and in front of its far parts")
/* celdepth:compose, help of a layer */
N_("The first picture")
/* celdepth:compose, help of a layer */
N_("The expanded depth levels of the first picture")
/* celdepth:compose, layer */
N_("Second art")
/* celdepth:compose, help of a layer */
N_("The picture to put between the levels of the first one")
/* celdepth:compose, layer */
N_("Second levels")
/* celdepth:compose, help of a layer */
N_("The expanded depth levels of the second picture, of which the farthest is left out as its page. Without them all of it is one part")
/* celdepth:compose, help */
N_("The picture, or its depth levels")
/* celdepth:compose, label */
N_("Behind levels above")
/* celdepth:compose, help */
N_("The second picture lies behind the parts of the first one whose level is above this, and in front of all others")
/* celdepth:compose, label */
N_("X")
/* celdepth:compose, help */
N_("Where the left side of the second picture comes, in pixels")
/* celdepth:compose, label */
N_("Y")
/* celdepth:compose, help */
N_("Where the upper side of the second picture comes, in pixels")
/* celdepth:compose, label */
N_("Scale")
/* celdepth:compose, help */
N_("By how much the second picture is enlarged")
/* celdepth:compose, label */
N_("Turn")
/* celdepth:compose, help */
N_("By how much the second picture is turned clockwise round its middle")
/* celdepth:compose, label */
N_("Flip")
/* celdepth:compose, help */
N_("Mirrors the second picture, left to right, before it is turned")
/* celdepth:popup, title */
N_("Pop-up")
/* celdepth:popup, description */
N_("Finds depth for a line drawing in one step, from scribbles over its parts and arrows from nearer to farther parts")
/* celdepth:popup, layer */
N_("Hidden")
/* celdepth:popup, help of a layer */
N_("What is hidden: strokes in a region's colour where it goes on behind nearer ones, black where it does not")
/* celdepth:popup, choice */
N_("Order: the level of each region")
/* celdepth:popup, choice */
N_("Suggestions: arrows from parts that seem nearer")
/* celdepth:popup, help */
N_("The step of the method whose result is shown. In order, levels and depth nearer parts are lighter, in linear numbers")
/* celdepth:live-popup, title */
N_("Live pop-up")
/* celdepth:live-popup, description */
N_("Pop-up as an effect on a layer group, which follows what is painted on its layers. In GIMP, Cartoon Depth > Live group makes it")
/* celdepth:live-popup, layer */
N_("Group")
/* celdepth:live-popup, help of a layer */
N_("All layers over each other; the line drawing if there is no other one")
/* celdepth:live-popup, help of a layer */
N_("Strokes over lines, in the colour of the part that a line belongs to")
