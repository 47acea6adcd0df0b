// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef TESTS_RUN_BEAM_DECK_H
#define TESTS_RUN_BEAM_DECK_H

/** A clamped beam on the floor of a periodic channel with a lid, in a fluid that a body force drives: the
 * text of a deck with places for the formulation, the treatments of the wet surface (floor and beam) and of
 * the lid, and attributes of <coupling>. The gap between tip and lid is 4 spacings, so that some particles
 * see both walls. */
static const char beam_deck[] =
    "<deck version='1' dim='2'>\n"
    "<parameters>\n"
    "  <parameter name='dx' value='0.05'/><parameter name='c' value='10'/><parameter name='b' value='12'/>\n"
    "  <parameter name='ratio' value='10'/><parameter name='young' value='800'/>\n"
    "</parameters>\n"
    "<time end='1' step='0.25*dx/c'><body-force value='b -0.3*b'/></time>\n"
    "<domain lower='0 -4*dx' upper='1 0.6+4*dx' periodic='x'/>\n"
    "<materials>\n"
    "  <fluid name='water' density='1.1' kinematic-viscosity='0.02' sound-speed='c' "
    "background-pressure='c^2'/>\n"
    "  <solid name='rubber' density='1.1*ratio' young='young' poisson='0.35'/>\n"
    "</materials>\n"
    "<fluid formulation='%s' material='water' spacing='dx' arithmetic='double'>\n"
    "  <region><difference><box lower='0 0' upper='1 0.6'/><box lower='0.45 0' upper='0.6 0.4'/>"
    "</difference></region>\n"
    "</fluid>\n"
    "<meshes><mesh name='beam' material='rubber' newton-tolerance='1e-12'>\n"
    "  <grid lower='0.45 0' upper='0.6 0.4' cells='2 5'/>\n"
    "  <set name='root'><box lower='0.45 0' upper='0.6 0'/></set><support set='root' fixed='x y'/>\n"
    "</mesh></meshes>\n"
    "<surfaces>\n"
    "  <surface name='wet'><skin mesh='beam' exclude='root'/>\n"
    "    <segments points='1 0 0.6 0' fluid='right'/><segments points='0.45 0 0 0' "
    "fluid='right'/></surface>\n"
    "  <surface name='lid'><plane point='0 0.6' normal='0 -1'/></surface>\n"
    "</surfaces>\n"
    "<boundaries>\n"
    "  <wall name='wet' surfaces='wet' treatment='%s'/><wall name='lid' surfaces='lid' treatment='%s'/>\n"
    "</boundaries>\n"
    "<coupling %s/>\n"
    "<output><fields every='1'/></output>\n"
    "</deck>\n";

#endif
