// SPDX-License-Identifier: GPL-3.0-or-later
#include "deck/deck_schema.h"

#include <string.h>

static const struct schema_attribute deck_attributes[] = {
    {"version", SCHEMA_CHOICE, .required = true, .choices = "1", .doc = "version of the deck language"},
    {"dim", SCHEMA_CHOICE, .required = true, .choices = "1|2|3",
     .doc = "dimension of space; 2-D problems lie in the x-y plane and have unit depth, so that forces are "
            "per metre"},
    {0}};

static const struct schema_child deck_children[] = {
    {SCHEMA_PARAMETERS, 0, 1}, {SCHEMA_TIME, 1, 1},   {SCHEMA_DOMAIN, 0, 1},      {SCHEMA_MATERIALS, 0, 1},
    {SCHEMA_FLUID, 0, 1},      {SCHEMA_MESHES, 0, 1}, {SCHEMA_SURFACES, 0, 1},    {SCHEMA_BOUNDARIES, 0, 1},
    {SCHEMA_COUPLING, 0, 1},   {SCHEMA_OUTPUT, 1, 1}, {SCHEMA_ELEMENTS_END, 0, 0}};

static const struct schema_child parameters_children[] = {
    {SCHEMA_PARAMETER, 0, 0}, {SCHEMA_FUNCTION, 0, 0}, {SCHEMA_ELEMENTS_END, 0, 0}};

static const struct schema_attribute parameter_attributes[] = {
    {"name", SCHEMA_NAME, .required = true, .doc = "letters, digits and underscores"},
    {"value", SCHEMA_TEXT, .required = true,
     .doc =
         "a number, a number with a unit (converted to SI), or an expression over the parameters above it"},
    {0}};

static const struct schema_attribute function_attributes[] = {
    {"name", SCHEMA_NAME, .required = true,
     .doc = "letters, digits and underscores; used without parentheses"},
    {"value", SCHEMA_EXPRESSION, .required = true, .variables = "xyzt",
     .doc = "may use the parameters and functions above it"},
    {0}};

static const struct schema_attribute time_attributes[] = {
    {"end", SCHEMA_REAL, .required = true, .range = RANGE_POSITIVE, .unit = "s",
     .doc = "end of the simulated time"},
    {"step", SCHEMA_REAL, .required = true, .range = RANGE_POSITIVE, .unit = "s",
     .doc = "length of every time step"},
    {0}};

static const struct schema_child time_children[] = {{SCHEMA_BODY_FORCE, 0, 1}, {SCHEMA_ELEMENTS_END, 0, 0}};

static const struct schema_attribute body_force_attributes[] = {{"value", SCHEMA_EXPRESSIONS,
                                                                 .required = true, .unit = "m/s2",
                                                                 .variables = "t", .doc = "force per mass"},
                                                                {0}};

static const struct schema_attribute domain_attributes[] = {
    {"lower", SCHEMA_VECTOR, .required = true, .unit = "m", .doc = "lower corner"},
    {"upper", SCHEMA_VECTOR, .required = true, .unit = "m", .doc = "upper corner"},
    {"periodic", SCHEMA_CHOICES, .choices = "x|y|z", .fallback = "",
     .doc =
         "directions in which the domain repeats: particles come back through the other side, surfaces and "
         "meshes keep their coordinates"},
    {"outside", SCHEMA_CHOICE, .choices = "stop|remove", .fallback = "stop",
     .doc =
         "what happens to a particle that leaves: the run stops with an error, or the particle is removed"},
    {0}};

static const struct schema_child materials_children[] = {
    {SCHEMA_FLUID_MATERIAL, 0, 0}, {SCHEMA_SOLID_MATERIAL, 0, 0}, {SCHEMA_ELEMENTS_END, 0, 0}};

static const struct schema_attribute fluid_material_attributes[] = {
    {"name", SCHEMA_NAME, .required = true, .doc = "name to refer to"},
    {"density", SCHEMA_REAL, .required = true, .range = RANGE_POSITIVE, .unit = "kg/m3",
     .doc = "reference density"},
    {"kinematic-viscosity", SCHEMA_REAL, .required = true, .range = RANGE_NOT_NEGATIVE, .unit = "m2/s",
     .doc = "dynamic viscosity by density"},
    {"sound-speed", SCHEMA_REAL, .required = true, .range = RANGE_POSITIVE, .unit = "m/s",
     .doc = "artificial speed of sound of the linear equation of state p = c^2 (rho - rho0); at least ten "
            "times the "
            "highest flow speed"},
    {"background-pressure", SCHEMA_REAL, .required = true, .range = RANGE_NOT_NEGATIVE, .unit = "Pa",
     .doc = "of the transport velocity, which keeps particles evenly spread; usually density times sound "
            "speed squared; 0 "
            "switches it off"},
    {0}};

static const struct schema_attribute solid_material_attributes[] = {
    {"name", SCHEMA_NAME, .required = true, .doc = "name to refer to"},
    {"law", SCHEMA_CHOICE, .choices = "saint-venant-kirchhoff|neo-hookean",
     .fallback = "saint-venant-kirchhoff",
     .doc = "stress-strain law; neo-hookean for large strains: mu tr E - mu ln J + lambda/2 ln^2 J"},
    {"density", SCHEMA_REAL, .required = true, .range = RANGE_POSITIVE, .unit = "kg/m3",
     .doc = "in the undeformed state"},
    {"young", SCHEMA_REAL, .required = true, .range = RANGE_POSITIVE, .unit = "Pa", .doc = "Young's modulus"},
    {"poisson", SCHEMA_REAL, .required = true, .range = RANGE_POISSON, .doc = "Poisson's ratio"},
    {0}};

static const struct schema_attribute fluid_attributes[] = {
    {"formulation", SCHEMA_CHOICE, .choices = "transport-velocity", .fallback = "transport-velocity",
     .doc = "how the flow equations are discretised"},
    {"material", SCHEMA_REFERENCE, .required = true, .doc = "a <fluid> of <materials>"},
    {"spacing", SCHEMA_REAL, .required = true, .range = RANGE_POSITIVE, .unit = "m",
     .doc = "initial particle spacing dx"},
    {"kernel", SCHEMA_CHOICE, .choices = "quintic-spline", .fallback = "quintic-spline",
     .doc = "smoothing kernel"},
    {"kernel-constant", SCHEMA_CHOICE, .choices = "exact|published", .fallback = "exact",
     .doc = "normalisation of the kernel: exact, or in 3-D the value often printed (3/(359 pi))"},
    {"smoothing-length-ratio", SCHEMA_REAL, .range = RANGE_POSITIVE, .fallback = "1",
     .doc = "smoothing length by spacing"},
    {"damping", SCHEMA_REAL, .range = RANGE_NOT_NEGATIVE, .unit = "1/s", .fallback = "0",
     .doc = "global damping -d u of the acceleration, to settle into a state of rest"},
    {"arithmetic", SCHEMA_CHOICE, .choices = "mixed|double", .fallback = "mixed",
     .doc = "of sums over pairs of fluid particles: single precision pairs with exact positions, or double "
            "throughout"},
    {"convective-stress", SCHEMA_CHOICE, .choices = "included|omitted", .fallback = "included",
     .doc = "of transport velocities, in the momentum equation (Adami, Hu and Adams 2013); omitted, momentum "
            "moves with the transport velocity as mass does, which adds a little diffusion instead of noise"},
    {0}};

static const struct schema_child fluid_children[] = {{SCHEMA_REGION, 1, 0}, {SCHEMA_ELEMENTS_END, 0, 0}};

static const struct schema_attribute region_attributes[] = {
    {"origin", SCHEMA_VECTOR, .unit = "m",
     .doc = "corner of a cell of the particle lattice; default: lower corner of the shape's bounding box"},
    {"velocity", SCHEMA_EXPRESSIONS, .unit = "m/s", .variables = "xyz",
     .doc = "initial velocity; default: at rest"},
    {0}};

static const struct schema_child region_children[] = {{SCHEMA_POINT_LIST, 0, 1}, {SCHEMA_ELEMENTS_END, 0, 0}};

static const struct schema_child shapes[] = {
    {SCHEMA_BOX, 0, 0},          {SCHEMA_DISC, 0, 0},           {SCHEMA_BALL, 0, 0},
    {SCHEMA_ANNULUS, 0, 0},      {SCHEMA_CYLINDER_SHAPE, 0, 0}, {SCHEMA_POLYGON, 0, 0},
    {SCHEMA_HALF_SPACE, 0, 0},   {SCHEMA_INSIDE, 0, 0},         {SCHEMA_UNION, 0, 0},
    {SCHEMA_INTERSECTION, 0, 0}, {SCHEMA_DIFFERENCE, 0, 0},     {SCHEMA_ELEMENTS_END, 0, 0}};

static const struct schema_attribute box_attributes[] = {
    {"lower", SCHEMA_VECTOR, .required = true, .unit = "m", .doc = "lower corner"},
    {"upper", SCHEMA_VECTOR, .required = true, .unit = "m", .doc = "upper corner"},
    {0}};

static const struct schema_attribute ball_attributes[] = {
    {"centre", SCHEMA_VECTOR, .required = true, .unit = "m", .doc = "centre"},
    {"radius", SCHEMA_REAL, .required = true, .range = RANGE_POSITIVE, .unit = "m", .doc = "radius"},
    {0}};

static const struct schema_attribute annulus_attributes[] = {
    {"centre", SCHEMA_VECTOR, .required = true, .unit = "m", .doc = "centre"},
    {"inner-radius", SCHEMA_REAL, .required = true, .range = RANGE_NOT_NEGATIVE, .unit = "m",
     .doc = "radius of the hole"},
    {"radius", SCHEMA_REAL, .required = true, .range = RANGE_POSITIVE, .unit = "m", .doc = "outer radius"},
    {0}};

static const struct schema_attribute cylinder_shape_attributes[] = {
    {"from", SCHEMA_VECTOR, .required = true, .unit = "m", .doc = "one end of the axis"},
    {"to", SCHEMA_VECTOR, .required = true, .unit = "m", .doc = "other end of the axis"},
    {"radius", SCHEMA_REAL, .required = true, .range = RANGE_POSITIVE, .unit = "m", .doc = "outer radius"},
    {"inner-radius", SCHEMA_REAL, .range = RANGE_NOT_NEGATIVE, .unit = "m", .fallback = "0",
     .doc = "radius of the bore"},
    {0}};

static const struct schema_attribute polygon_attributes[] = {
    {"points", SCHEMA_POINTS, .required = true, .unit = "m", .doc = "corners in order: x y x y ..."}, {0}};

static const struct schema_attribute half_space_attributes[] = {
    {"point", SCHEMA_VECTOR, .required = true, .unit = "m", .doc = "a point of the plane that bounds it"},
    {"normal", SCHEMA_VECTOR, .required = true, .doc = "direction out of the half-space"},
    {0}};

static const struct schema_attribute inside_attributes[] = {
    {"surface", SCHEMA_REFERENCE, .required = true,
     .doc = "a closed <surface>, or a plane: the side away from the fluid"},
    {0}};

static const struct schema_attribute point_list_attributes[] = {
    {"file", SCHEMA_TEXT,
     .doc = "file with the same numbers, beside the deck or in a folder below it; text after # on a line is "
            "ignored"},
    {0}};

static const struct schema_child meshes_children[] = {{SCHEMA_MESH, 0, 0}, {SCHEMA_ELEMENTS_END, 0, 0}};

static const struct schema_attribute mesh_attributes[] = {
    {"name", SCHEMA_NAME, .required = true, .doc = "name to refer to; also names its output files"},
    {"material", SCHEMA_REFERENCE,
     .doc = "a <solid> of <materials>; required unless a <rigid> says how dense the mesh is"},
    {"formulation", SCHEMA_CHOICE, .choices = "full|f-bar|eas", .fallback = "eas",
     .doc = "element technology: full integration, F-bar (nearly incompressible), enhanced assumed strain "
            "(bending); the latter two for quad4 and hex8"},
    {"rho-infinity", SCHEMA_REAL, .range = RANGE_FRACTION, .fallback = "0.8",
     .doc = "spectral radius at infinite frequency of the generalised-alpha method; 1: no damping"},
    {"newton-tolerance", SCHEMA_REAL, .range = RANGE_POSITIVE, .fallback = "1e-8",
     .doc = "relative residual at which Newton's method stops"},
    {0}};

static const struct schema_child mesh_children[] = {
    {SCHEMA_GRID, 0, 1},       {SCHEMA_DISC_MESH, 0, 1}, {SCHEMA_NODES, 0, 1},       {SCHEMA_ELEMENTS, 0, 1},
    {SCHEMA_RIGID, 0, 1},      {SCHEMA_SET, 0, 0},       {SCHEMA_SUPPORT, 0, 0},     {SCHEMA_LOAD, 0, 0},
    {SCHEMA_BODY_FORCE, 0, 1}, {SCHEMA_INITIAL, 0, 1},   {SCHEMA_ELEMENTS_END, 0, 0}};

#define SOLID_ELEMENTS "tri3|quad4|tet4|hex8|tri6|quad8|quad9|tet10|hex20|hex27"

static const struct schema_attribute grid_attributes[] = {
    {"lower", SCHEMA_VECTOR, .required = true, .unit = "m", .doc = "lower corner"},
    {"upper", SCHEMA_VECTOR, .required = true, .unit = "m", .doc = "upper corner"},
    {"cells", SCHEMA_CELLS, .required = true, .range = RANGE_POSITIVE,
     .doc = "number of elements in each direction; simplices: of boxes that are cut into 2 or 6 of them"},
    {"type", SCHEMA_CHOICE, .choices = SOLID_ELEMENTS,
     .doc = "kind of all elements; default: quad4 or hex8; quadratic ones (tri6, quad8, quad9, tet10, hex20, "
            "hex27) need formulation=\"full\""},
    {0}};

static const struct schema_child grid_children[] = {{SCHEMA_HOLE, 0, 0}, {SCHEMA_ELEMENTS_END, 0, 0}};

static const struct schema_child hole_shapes[] = {
    {SCHEMA_BOX, 0, 0},     {SCHEMA_DISC, 0, 0},           {SCHEMA_BALL, 0, 0},        {SCHEMA_ANNULUS, 0, 0},
    {SCHEMA_POLYGON, 0, 0}, {SCHEMA_CYLINDER_SHAPE, 0, 0}, {SCHEMA_ELEMENTS_END, 0, 0}};

static const struct schema_attribute disc_mesh_attributes[] = {
    {"centre", SCHEMA_VECTOR, .required = true, .unit = "m", .doc = "centre"},
    {"radius", SCHEMA_REAL, .required = true, .range = RANGE_POSITIVE, .unit = "m",
     .doc = "radius; nodes of the rim lie on the circle and form the node set rim"},
    {"cells", SCHEMA_INTEGER, .required = true, .range = RANGE_POSITIVE,
     .doc = "number of elements across, at least 2: a square of cells x cells elements bent round, with 4 "
            "cells of "
            "equal sides on the rim"},
    {"type", SCHEMA_CHOICE, .choices = "quad4|quad8|quad9", .fallback = "quad4",
     .doc = "kind of all elements; the quadratic ones need formulation=\"full\""},
    {0}};

static const struct schema_attribute rigid_attributes[] = {
    {"density", SCHEMA_REAL, .range = RANGE_POSITIVE, .unit = "kg/m3",
     .doc =
         "gives mass, centre of mass and inertia by the geometry of the mesh; default: that of the material"},
    {"mass", SCHEMA_REAL, .range = RANGE_POSITIVE, .unit = "kg", .unit_2d = "kg/m",
     .doc = "instead of a density, spread evenly over the mesh unless inertia is given"},
    {"centre", SCHEMA_VECTOR, .unit = "m",
     .doc = "centre of mass; needs inertia too; default: that of the mesh"},
    {"inertia", SCHEMA_INERTIA, .unit = "kg m2", .unit_2d = "kg m",
     .doc = "about the centre of mass: in 2-D that about z, in 3-D the entries xx yy zz xy yz xz of the "
            "tensor (the "
            "latter three negative integrals of products); default: that of the mesh"},
    {"fixed", SCHEMA_CHOICES, .choices = "x|y|z|rotation-x|rotation-y|rotation-z", .fallback = "",
     .doc = "directions in which the centre of mass is held, and axes through it, fixed in space, about "
            "which the body "
            "does not turn; in 2-D x, y, rotation-z"},
    {"velocity", SCHEMA_VECTOR, .unit = "m/s", .doc = "of the centre of mass at time 0; default: 0"},
    {"angular-velocity", SCHEMA_TURN, .unit = "rad/s",
     .doc = "at time 0, in 2-D about z, in 3-D about x, y, z; default: 0"},
    {0}};

static const struct schema_attribute elements_attributes[] = {
    {"type", SCHEMA_CHOICE, .required = true, .choices = "line2|" SOLID_ELEMENTS,
     .doc = "kind of all elements; nodes in VTK order"},
    {0}};

static const struct schema_attribute set_attributes[] = {
    {"name", SCHEMA_NAME, .required = true, .doc = "name to refer to"},
    {"nodes", SCHEMA_INTEGERS, .doc = "node numbers, counted from 0; or a <box> inside"},
    {0}};

static const struct schema_child set_children[] = {{SCHEMA_BOX, 0, 1}, {SCHEMA_ELEMENTS_END, 0, 0}};

static const struct schema_attribute support_attributes[] = {
    {"set", SCHEMA_REFERENCE, .required = true,
     .doc = "a node set of the mesh; a grid has x- x+ y- y+ (z- z+), a disc has rim"},
    {"fixed", SCHEMA_CHOICES, .choices = "x|y|z", .fallback = "",
     .doc = "directions in which the nodes are held"},
    {0}};

static const struct schema_child motion_children[] = {{SCHEMA_ROTATION, 0, 1},
                                                      {SCHEMA_TRANSLATION, 0, 1},
                                                      {SCHEMA_DISPLACEMENT, 0, 1},
                                                      {SCHEMA_ELEMENTS_END, 0, 0}};

static const struct schema_attribute load_attributes[] = {
    {"set", SCHEMA_REFERENCE, .required = true, .doc = "a node set of the mesh"},
    {"force", SCHEMA_EXPRESSIONS, .required = true, .unit = "N", .unit_2d = "N/m", .variables = "t",
     .doc = "total force on the set, shared equally by its nodes"},
    {0}};

static const struct schema_attribute initial_attributes[] = {
    {"displacement", SCHEMA_EXPRESSIONS, .unit = "m", .variables = "xyz",
     .doc = "initial displacement; default: 0"},
    {"velocity", SCHEMA_EXPRESSIONS, .unit = "m/s", .variables = "xyz",
     .doc = "initial velocity; default: 0"},
    {0}};

static const struct schema_child surfaces_children[] = {{SCHEMA_SURFACE, 0, 0}, {SCHEMA_ELEMENTS_END, 0, 0}};

static const struct schema_attribute surface_attributes[] = {
    {"name", SCHEMA_NAME, .required = true, .doc = "name to refer to"}, {0}};

static const struct schema_child surface_children[] = {{SCHEMA_SKIN, 0, 0},
                                                       {SCHEMA_ARC, 0, 0},
                                                       {SCHEMA_SEGMENTS, 0, 0},
                                                       {SCHEMA_FACETS, 0, 0},
                                                       {SCHEMA_PLANE, 0, 1},
                                                       {SCHEMA_CIRCLE, 0, 1},
                                                       {SCHEMA_CYLINDER_SURFACE, 0, 1},
                                                       {SCHEMA_SPHERE, 0, 1},
                                                       {SCHEMA_ROTATION, 0, 1},
                                                       {SCHEMA_TRANSLATION, 0, 1},
                                                       {SCHEMA_DISPLACEMENT, 0, 1},
                                                       {SCHEMA_ELEMENTS_END, 0, 0}};

static const struct schema_attribute skin_attributes[] = {
    {"mesh", SCHEMA_REFERENCE, .required = true, .doc = "a <mesh>"},
    {"exclude", SCHEMA_REFERENCES,
     .doc = "node sets of the mesh: sides of elements all of whose nodes belong to one of them are left out"},
    {0}};

static const struct schema_attribute arc_attributes[] = {
    {"centre", SCHEMA_VECTOR, .required = true, .unit = "m", .doc = "centre"},
    {"radius", SCHEMA_REAL, .required = true, .range = RANGE_POSITIVE, .unit = "m", .doc = "radius"},
    {"from", SCHEMA_REAL, .unit = "rad", .fallback = "0", .doc = "angle from the x axis at which it begins"},
    {"to", SCHEMA_REAL, .unit = "rad", .fallback = "2*pi", .doc = "angle at which it ends"},
    {"segments", SCHEMA_INTEGER, .required = true, .range = RANGE_POSITIVE,
     .doc = "number of straight segments"},
    {"fluid", SCHEMA_CHOICE, .choices = "outside|inside", .fallback = "outside", .doc = "where the fluid is"},
    {0}};

static const struct schema_attribute segments_attributes[] = {
    {"points", SCHEMA_POINTS, .required = true, .unit = "m", .doc = "points in order: x y x y ..."},
    {"closed", SCHEMA_CHOICE, .choices = "no|yes", .fallback = "no",
     .doc = "whether the last point joins the first"},
    {"fluid", SCHEMA_CHOICE, .required = true, .choices = "left|right",
     .doc = "side of the fluid, in walking direction"},
    {0}};

static const struct schema_child facets_children[] = {
    {SCHEMA_NODES, 1, 1}, {SCHEMA_ELEMENTS, 1, 1}, {SCHEMA_ELEMENTS_END, 0, 0}};

static const struct schema_attribute plane_attributes[] = {
    {"point", SCHEMA_VECTOR, .required = true, .unit = "m", .doc = "a point of the plane"},
    {"normal", SCHEMA_VECTOR, .required = true, .doc = "direction into the fluid"},
    {0}};

static const struct schema_attribute circle_attributes[] = {
    {"centre", SCHEMA_VECTOR, .required = true, .unit = "m", .doc = "centre"},
    {"radius", SCHEMA_REAL, .required = true, .range = RANGE_POSITIVE, .unit = "m", .doc = "radius"},
    {"fluid", SCHEMA_CHOICE, .required = true, .choices = "outside|inside", .doc = "where the fluid is"},
    {0}};

static const struct schema_attribute cylinder_surface_attributes[] = {
    {"centre", SCHEMA_VECTOR, .required = true, .unit = "m", .doc = "a point of the axis"},
    {"axis", SCHEMA_VECTOR, .required = true, .doc = "direction of the axis"},
    {"radius", SCHEMA_REAL, .required = true, .range = RANGE_POSITIVE, .unit = "m", .doc = "radius"},
    {"fluid", SCHEMA_CHOICE, .required = true, .choices = "outside|inside", .doc = "where the fluid is"},
    {0}};

static const struct schema_attribute rotation_attributes[] = {
    {"centre", SCHEMA_VECTOR, .required = true, .unit = "m", .doc = "a point of the axis"},
    {"axis", SCHEMA_VECTOR, .doc = "direction of the axis (3-D only, where it is needed)"},
    {"angle", SCHEMA_EXPRESSION, .required = true, .unit = "rad", .variables = "t", .doc = "angle turned"},
    {"velocity", SCHEMA_EXPRESSION, .unit = "rad/s", .variables = "t",
     .doc = "its derivative; default: differences"},
    {"acceleration", SCHEMA_EXPRESSION, .unit = "rad/s2", .variables = "t",
     .doc = "its second derivative; default: differences"},
    {0}};

static const struct schema_attribute translation_attributes[] = {
    {"value", SCHEMA_EXPRESSIONS, .required = true, .unit = "m", .variables = "t",
     .doc = "displacement of the whole body"},
    {"velocity", SCHEMA_EXPRESSIONS, .unit = "m/s", .variables = "t",
     .doc = "its derivative; default: differences"},
    {"acceleration", SCHEMA_EXPRESSIONS, .unit = "m/s2", .variables = "t",
     .doc = "its second derivative; default: differences"},
    {0}};

static const struct schema_attribute displacement_attributes[] = {
    {"value", SCHEMA_EXPRESSIONS, .required = true, .unit = "m", .variables = "xyzt",
     .doc = "displacement of the point whose undeformed place is x, y, z"},
    {"velocity", SCHEMA_EXPRESSIONS, .unit = "m/s", .variables = "xyzt",
     .doc = "its derivative; default: differences"},
    {"acceleration", SCHEMA_EXPRESSIONS, .unit = "m/s2", .variables = "xyzt",
     .doc = "its second derivative; default: differences"},
    {0}};

static const struct schema_child boundaries_children[] = {
    {SCHEMA_WALL, 0, 0}, {SCHEMA_INFLOW, 0, 0}, {SCHEMA_OUTFLOW, 0, 0}, {SCHEMA_ELEMENTS_END, 0, 0}};

static const struct schema_attribute wall_attributes[] = {
    {"name", SCHEMA_NAME, .required = true, .doc = "name to refer to"},
    {"surfaces", SCHEMA_REFERENCES,
     .doc = "the <surface>s it consists of; or a <region> of wall particles inside"},
    {"treatment", SCHEMA_CHOICE, .required = true, .choices = "fixed-particles|sliding-particles",
     .doc = "layers of wall particles that stay on the wall (in a mesh: on its material), or virtual "
            "particles that slide along with each fluid particle"},
    {"corners", SCHEMA_CHOICE, .choices = "shares|paper", .fallback = "shares",
     .doc = "sliding-particles where facets meet: shares of the facets, or contact points as published"},
    {"pressure-gradient", SCHEMA_CHOICE, .choices = "yes|no", .fallback = "yes",
     .doc = "sliding-particles: whether the pressure varies linearly across the wall"},
    {0}};

static const struct schema_child wall_children[] = {{SCHEMA_REGION, 0, 1},
                                                    {SCHEMA_ROTATION, 0, 1},
                                                    {SCHEMA_TRANSLATION, 0, 1},
                                                    {SCHEMA_DISPLACEMENT, 0, 1},
                                                    {SCHEMA_ELEMENTS_END, 0, 0}};

static const struct schema_attribute inflow_attributes[] = {
    {"name", SCHEMA_NAME, .required = true, .doc = "name to refer to"},
    {"axis", SCHEMA_CHOICE, .required = true, .choices = "x|y|z", .doc = "direction across the opening"},
    {"at", SCHEMA_REAL, .required = true, .unit = "m", .doc = "coordinate of its plane along the axis"},
    {"into", SCHEMA_CHOICE, .required = true, .choices = "+|-",
     .doc = "direction along the axis in which the fluid lies"},
    {"lower", SCHEMA_VECTOR, .unit = "m", .doc = "lower corner of the opening; default: of the domain"},
    {"upper", SCHEMA_VECTOR, .unit = "m", .doc = "upper corner of the opening; default: of the domain"},
    {"velocity", SCHEMA_EXPRESSIONS, .required = true, .unit = "m/s", .variables = "xyzt",
     .doc = "prescribed velocity"},
    {0}};

static const struct schema_attribute outflow_attributes[] = {
    {"name", SCHEMA_NAME, .required = true, .doc = "name to refer to"},
    {"axis", SCHEMA_CHOICE, .required = true, .choices = "x|y|z", .doc = "direction across the opening"},
    {"at", SCHEMA_REAL, .required = true, .unit = "m", .doc = "coordinate of its plane along the axis"},
    {"into", SCHEMA_CHOICE, .required = true, .choices = "+|-",
     .doc = "direction along the axis in which the fluid lies"},
    {"lower", SCHEMA_VECTOR, .unit = "m", .doc = "lower corner of the opening; default: of the domain"},
    {"upper", SCHEMA_VECTOR, .unit = "m", .doc = "upper corner of the opening; default: of the domain"},
    {"pressure", SCHEMA_EXPRESSION, .unit = "Pa", .variables = "xyzt", .fallback = "0",
     .doc = "prescribed pressure"},
    {"velocity", SCHEMA_CHOICE, .choices = "characteristic|momentum", .fallback = "characteristic",
     .doc = "how particles beyond the plane get their velocity"},
    {0}};

static const struct schema_attribute coupling_attributes[] = {
    {"scheme", SCHEMA_CHOICE, .choices = "fixed-point|sub-cycled|none",
     .doc = "how fluid and solid meet: fixed-point iterates in each step until they agree; in sub-cycled the "
            "solid takes steps of several fluid steps, meets the mean load of the fluid, and nothing is "
            "iterated; default: fixed-point where a wall has the skin of a mesh, otherwise none"},
    {"solid-every", SCHEMA_INTEGER, .range = RANGE_POSITIVE,
     .doc = "scheme=\"sub-cycled\": fluid steps in one step of the solid; output inside such a step shows "
            "surfaces where the fluid meets them and the solid as it was at its start; default: 2"},
    {"tolerance", SCHEMA_REAL, .range = RANGE_POSITIVE, .unit = "m/s",
     .doc = "change of the interface displacement in one iteration, by step length and root of the number of "
            "degrees of freedom, at which the iteration stops; default: 1e-8, or not looked at where only "
            "force-tolerance is given"},
    {"force-tolerance", SCHEMA_REAL, .range = RANGE_POSITIVE, .unit = "N", .unit_2d = "N/m",
     .doc = "change of the forces on the interface nodes (root of the sum of squares) from one iteration to "
            "the next at which the iteration stops; with tolerance both must hold; default: not looked at"},
    {"iterations", SCHEMA_INTEGER, .range = RANGE_POSITIVE, .fallback = "50",
     .doc = "most iterations in a step"},
    {"acceleration", SCHEMA_CHOICE, .choices = "added-mass|iqn-ils|aitken|constant|none",
     .fallback = "added-mass",
     .doc = "what makes the iteration converge fast: the fluid's added mass in the solid's equations, a "
            "quasi-Newton method that learns from the iterations of this step and the last ones, or "
            "relaxation"},
    {"relaxation", SCHEMA_REAL, .range = RANGE_POSITIVE, .fallback = "1",
     .doc = "relaxation factor: the only one of constant, the first one of aitken, that of iqn-ils as long "
            "as there is nothing to learn from"},
    {"reused-steps", SCHEMA_INTEGER, .range = RANGE_NOT_NEGATIVE,
     .doc = "acceleration=\"iqn-ils\": earlier steps it learns from; default: 5"},
    {"filter", SCHEMA_REAL, .range = RANGE_POSITIVE,
     .doc =
         "acceleration=\"iqn-ils\": what an iteration changed is forgotten if less than this part of it "
         "is independent of what newer ones changed (the smaller, the more is learned, and the less robust); "
         "less than 1; default: 1e-2"},
    {"predictor", SCHEMA_CHOICE, .choices = "linear-acceleration|constant-acceleration|zero-acceleration",
     .doc =
         "acceleration of the solid with which a step begins: extrapolated from the last two steps, that "
         "of the last step, or none; displacement and velocity follow from it as in time integration (a kept "
         "displacement would ask for an enormous acceleration); default: linear-acceleration, in sub-cycled "
         "constant-acceleration"},
    {0}};

static const struct schema_child output_children[] = {
    {SCHEMA_FIELDS, 1, 1}, {SCHEMA_HISTORY, 0, 0}, {SCHEMA_CHECKPOINTS, 0, 1}, {SCHEMA_ELEMENTS_END, 0, 0}};

static const struct schema_attribute fields_attributes[] = {
    {"every", SCHEMA_REAL, .required = true, .range = RANGE_POSITIVE, .unit = "s",
     .doc = "time between frames"},
    {"arrays", SCHEMA_CHOICES, .choices = "Vorticity|Acceleration|Support", .fallback = "",
     .doc = "arrays of the fluid besides density, mass, velocity, pressure, smoothing length, id and, with "
            "openings, kind"},
    {"precision", SCHEMA_CHOICE, .choices = "float32|float64", .fallback = "float32",
     .doc = "of numbers in the files"},
    {"virtual-particles", SCHEMA_INTEGERS, .fallback = "",
     .doc = "ids of fluid particles whose virtual boundary particles are written too"},
    {0}};

static const struct schema_attribute history_attributes[] = {
    {"name", SCHEMA_NAME, .required = true, .doc = "names its file history/NAME.csv"},
    {"type", SCHEMA_CHOICE, .required = true,
     .choices = "point|force|gauge|profile|volume|rigid|energy|coupling",
     .doc = "point: displacement and velocity of a material point; force: force and moment on surfaces; "
            "gauge: fluid "
            "fields at a place; profile: the same along a line; volume: number, mass and volume of fluid "
            "particles; "
            "rigid: centre of mass, rotation (2-D: angle turned so far; 3-D: rotation vector of the "
            "orientation), "
            "velocities, force and moment about the centre of a rigid body; "
            "energy: kinetic and elastic energies; coupling: iterations and residual of each step"},
    {"every", SCHEMA_REAL, .range = RANGE_NOT_NEGATIVE, .unit = "s", .fallback = "0",
     .doc = "time between rows; 0: every step"},
    {"mesh", SCHEMA_REFERENCE, .doc = "point, rigid: the mesh"},
    {"at", SCHEMA_VECTOR, .unit = "m", .doc = "point: undeformed place; gauge: place"},
    {"surfaces", SCHEMA_REFERENCES, .doc = "force: the surfaces"},
    {"lower", SCHEMA_VECTOR, .unit = "m",
     .doc = "volume: lower corner of a box outside of which particles do not count; default: all count"},
    {"upper", SCHEMA_VECTOR, .unit = "m", .doc = "volume: upper corner of the box"},
    {"from", SCHEMA_VECTOR, .unit = "m", .doc = "profile: first point"},
    {"to", SCHEMA_VECTOR, .unit = "m", .doc = "profile: last point"},
    {"points", SCHEMA_INTEGER, .range = RANGE_POSITIVE, .doc = "profile: number of points"},
    {0}};

static const struct schema_attribute checkpoints_attributes[] = {
    {"every", SCHEMA_REAL, .range = RANGE_NOT_NEGATIVE, .unit = "s", .fallback = "600",
     .doc = "wall-clock time between checkpoints; 0: after every step. One is also written at the end and "
            "when the run is stopped"},
    {0}};

static const struct schema_element elements[SCHEMA_ELEMENTS_END] =
    {[SCHEMA_DECK] = {"deck", "deck", "a whole problem", .attributes = deck_attributes,
                      .children = deck_children},
     [SCHEMA_PARAMETERS] = {"parameters", "parameters",
                            "named numbers and functions for use in all values below",
                            .children = parameters_children},
     [SCHEMA_PARAMETER] = {"parameter", "parameter", "a named number; --set NAME=VALUE replaces it",
                           .attributes = parameter_attributes},
     [SCHEMA_FUNCTION] = {"function", "function", "a named expression in x, y, z, t",
                          .attributes = function_attributes},
     [SCHEMA_TIME] = {"time", "time", "simulated time, time step, forces on everything",
                      .attributes = time_attributes, .children = time_children},
     [SCHEMA_BODY_FORCE] = {"body-force", "body-force", "a force on every mass, such as gravity",
                            .attributes = body_force_attributes},
     [SCHEMA_DOMAIN] = {"domain", "domain", "the box in which particles may be",
                        .attributes = domain_attributes},
     [SCHEMA_MATERIALS] = {"materials", "materials", "what things are made of",
                           .children = materials_children},
     [SCHEMA_FLUID_MATERIAL] = {"fluid", "fluid-material", "a weakly compressible fluid",
                                .attributes = fluid_material_attributes},
     [SCHEMA_SOLID_MATERIAL] = {"solid", "solid-material", "an elastic solid",
                                .attributes = solid_material_attributes},
     [SCHEMA_FLUID] = {"fluid", "fluid", "the flow: method and particles to begin with",
                       .attributes = fluid_attributes, .children = fluid_children},
     [SCHEMA_REGION] = {"region", "region",
                        "a part of space filled with particles: one shape or one list of points",
                        .attributes = region_attributes, .children = region_children, .shapes = shapes,
                        .least_shapes = 0, .most_shapes = 1},
     [SCHEMA_BOX] = {"box", "box", "an axis-parallel box", .attributes = box_attributes},
     [SCHEMA_DISC] = {"disc", "disc", "a disc (2-D)", .attributes = ball_attributes},
     [SCHEMA_BALL] = {"ball", "ball", "a ball (3-D)", .attributes = ball_attributes},
     [SCHEMA_ANNULUS] = {"annulus", "annulus", "a disc with a hole (2-D)", .attributes = annulus_attributes},
     [SCHEMA_CYLINDER_SHAPE] = {"cylinder", "cylinder-shape",
                                "a cylinder, hollow if it has an inner radius (3-D)",
                                .attributes = cylinder_shape_attributes},
     [SCHEMA_POLYGON] = {"polygon", "polygon", "a polygon (2-D)", .attributes = polygon_attributes},
     [SCHEMA_HALF_SPACE] = {"half-space", "half-space", "everything on one side of a plane",
                            .attributes = half_space_attributes},
     [SCHEMA_INSIDE] = {"inside", "inside", "the solid side of a surface", .attributes = inside_attributes},
     [SCHEMA_UNION] = {"union", "union", "everything that lies in one of its shapes", .shapes = shapes,
                       .least_shapes = 1, .most_shapes = 0},
     [SCHEMA_INTERSECTION] = {"intersection", "intersection", "what lies in all its shapes", .shapes = shapes,
                              .least_shapes = 1, .most_shapes = 0},
     [SCHEMA_DIFFERENCE] = {"difference", "difference", "the first shape without all others",
                            .shapes = shapes, .least_shapes = 2, .most_shapes = 0},
     [SCHEMA_POINT_LIST] = {"points", "points", "particles at given places",
                            .attributes = point_list_attributes,
                            .text = "coordinates, dim numbers for each point, in m"},
     [SCHEMA_MESHES] = {"meshes", "meshes", "solids", .children = meshes_children},
     [SCHEMA_MESH] =
         {"mesh", "mesh",
          "a solid of finite elements: a <grid>, a <disc>, or <nodes> and <elements>; deformable, or with "
          "<rigid> a rigid body",
          .attributes = mesh_attributes, .children = mesh_children},
     [SCHEMA_GRID] =
         {"grid", "grid",
          "a box cut into elements, quad4 (2-D) or hex8 (3-D) unless told otherwise; <hole>s leave "
          "some of them out",
          .attributes = grid_attributes, .children = grid_children},
     [SCHEMA_HOLE] = {"hole", "hole",
                      "what a grid leaves out: elements whose centres lie in any of the shapes inside",
                      .shapes = hole_shapes, .least_shapes = 1, .most_shapes = 0},
     [SCHEMA_DISC_MESH] = {"disc", "disc-mesh", "a disc of quads (2-D)", .attributes = disc_mesh_attributes},
     [SCHEMA_RIGID] =
         {"rigid", "rigid",
          "makes the mesh a rigid body that forces move: translation and rotation instead of elements",
          .attributes = rigid_attributes},
     [SCHEMA_NODES] = {"nodes", "nodes", "places of nodes, numbered from 0",
                       .text = "coordinates, dim numbers for each node, in m"},
     [SCHEMA_ELEMENTS] =
         {"elements", "elements", "elements or facets by their nodes", .attributes = elements_attributes,
          .text = "node numbers of each element in the order of VTK; facets: counter-clockwise seen from the "
                  "fluid, line2: the fluid to the right"},
     [SCHEMA_SET] = {"set", "set", "a set of nodes: all in a box, or by number", .attributes = set_attributes,
                     .children = set_children},
     [SCHEMA_SUPPORT] = {"support", "support", "nodes that are held, or moved as prescribed",
                         .attributes = support_attributes, .children = motion_children},
     [SCHEMA_LOAD] = {"load", "load", "a force on a node set", .attributes = load_attributes},
     [SCHEMA_INITIAL] = {"initial", "initial", "state of a mesh at time 0", .attributes = initial_attributes},
     [SCHEMA_SURFACES] = {"surfaces", "surfaces", "surfaces between fluid and solids",
                          .children = surfaces_children},
     [SCHEMA_SURFACE] =
         {"surface", "surface",
          "facets (any number of skin, arc, segments, facets), or one plane, circle, cylinder or sphere; and "
          "the motion of what belongs to no mesh",
          .attributes = surface_attributes, .children = surface_children},
     [SCHEMA_SKIN] = {"skin", "skin", "the outside of a mesh", .attributes = skin_attributes},
     [SCHEMA_ARC] = {"arc", "arc", "a part of a circle cut into segments (2-D)",
                     .attributes = arc_attributes},
     [SCHEMA_SEGMENTS] = {"segments", "segments", "a chain of straight segments (2-D)",
                          .attributes = segments_attributes},
     [SCHEMA_FACETS] = {"facets", "facets", "line2 (2-D), tri3 or quad4 (3-D) facets by points",
                        .children = facets_children},
     [SCHEMA_PLANE] = {"plane", "plane", "an infinite plane (2-D: line; 1-D: point)",
                       .attributes = plane_attributes},
     [SCHEMA_CIRCLE] = {"circle", "circle", "a circle (2-D)", .attributes = circle_attributes},
     [SCHEMA_CYLINDER_SURFACE] = {"cylinder", "cylinder-surface", "an infinite cylinder (3-D)",
                                  .attributes = cylinder_surface_attributes},
     [SCHEMA_SPHERE] = {"sphere", "sphere", "a sphere (3-D)", .attributes = circle_attributes},
     [SCHEMA_ROTATION] = {"rotation", "rotation", "rigid rotation about a fixed axis",
                          .attributes = rotation_attributes},
     [SCHEMA_TRANSLATION] = {"translation", "translation",
                             "rigid translation, after the rotation if there is one",
                             .attributes = translation_attributes},
     [SCHEMA_DISPLACEMENT] = {"displacement", "displacement", "prescribed motion of each point on its own",
                              .attributes = displacement_attributes},
     [SCHEMA_BOUNDARIES] = {"boundaries", "boundaries", "how the fluid ends",
                            .children = boundaries_children},
     [SCHEMA_WALL] = {"wall", "wall", "a wall: a treatment of surfaces", .attributes = wall_attributes,
                      .children = wall_children},
     [SCHEMA_INFLOW] = {"inflow", "inflow", "an opening with prescribed velocity",
                        .attributes = inflow_attributes},
     [SCHEMA_OUTFLOW] = {"outflow", "outflow", "an opening with prescribed pressure",
                         .attributes = outflow_attributes},
     [SCHEMA_COUPLING] = {"coupling", "coupling", "how fluid and solids are solved together",
                          .attributes = coupling_attributes},
     [SCHEMA_OUTPUT] = {"output", "output", "what is written", .children = output_children},
     [SCHEMA_FIELDS] = {"fields", "fields", "frames for ParaView", .attributes = fields_attributes},
     [SCHEMA_HISTORY] = {"history", "history", "a table over time", .attributes = history_attributes},
     [SCHEMA_CHECKPOINTS] = {"checkpoints", "checkpoints", "states from which a run can be resumed",
                             .attributes = checkpoints_attributes}};

const struct schema_element *schema_element(enum schema_id id)
{
    return &elements[id];
}

size_t schema_attribute_count(const struct schema_element *element)
{
    size_t n = 0;
    while (element->attributes && element->attributes[n].name)
        n++;
    return n;
}

enum schema_id schema_find_child(const struct schema_element *element, const char *name)
{
    const struct schema_child *lists[2] = {element->children, element->shapes};
    for (int l = 0; l < 2; l++)
        for (const struct schema_child *child = lists[l]; child && child->id != SCHEMA_ELEMENTS_END; child++)
            if (strcmp(elements[child->id].name, name) == 0)
                return child->id;
    return SCHEMA_ELEMENTS_END;
}

size_t schema_child_names(const struct schema_element *element, const char **names, size_t size)
{
    const struct schema_child *lists[2] = {element->children, element->shapes};
    size_t n = 0;
    for (int l = 0; l < 2; l++)
        for (const struct schema_child *child = lists[l]; child && child->id != SCHEMA_ELEMENTS_END; child++)
            if (n < size)
                names[n++] = elements[child->id].name;
    return n;
}
