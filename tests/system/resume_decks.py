# SPDX-License-Identifier: GPL-3.0-or-later
"""Small decks of every combination of parts that exists, for the tests of resuming: what may be chosen is read from
the program's own schema, so that a new part takes part in them by being there."""

import itertools
import re
import subprocess

DX = 0.05

MATERIALS = """<materials>
  <fluid name="water" density="1.1" kinematic-viscosity="0.02" sound-speed="c" background-pressure="c^2"/>%s
</materials>
"""
RUBBER = '\n  <solid name="rubber" law="%s" density="11" young="%d" poisson="0.35"/>'
LAWS = ("saint-venant-kirchhoff", "neo-hookean")

YOUNG = {2: 4000, 3: 40000}

OUTPUT = """<output>
  <fields every="7.3*dt" precision="float64" arrays="Vorticity Acceleration Support" virtual-particles="3 40"/>
%s</output>
</deck>
"""


def choices(skerry):
    """{element: {attribute: [values]}} of the attributes with a fixed choice."""
    schema = subprocess.run([skerry, "schema"], check=True, stdout=subprocess.PIPE).stdout.decode()
    elements = {}
    for kind, body in re.findall(r'<xs:complexType name="([^"]+)">(.*?)</xs:complexType>', schema, re.S):
        for name, inner in re.findall(r'<xs:attribute name="([^"]+)"(.*?)</xs:attribute>', body, re.S):
            values = re.findall(r'<xs:enumeration value="([^"]+)"', inner)
            if values:
                elements.setdefault(kind, {})[name] = values
    return elements


def head(dim, force, lower, upper, periodic, solid="", factor=1.0):
    vector = " ".join
    return ("""<deck version="1" dim="%d">
<parameters>
  <parameter name="dx" value="%g"/><parameter name="c" value="10"/><parameter name="dt" value="%g*0.25*dx/c"/>
  <parameter name="end" value="1000*dt"/>
</parameters>
<time end="end" step="dt"><body-force value="%s"/></time>
<domain lower="%s" upper="%s" periodic="%s"/>
""" % (dim, DX, factor, vector(force[:dim]), vector(lower[:dim]), vector(upper[:dim]), periodic)
            + MATERIALS % solid)


def fluid(formulation, arithmetic, region, velocity=None):
    return """<fluid formulation="%s" material="water" spacing="dx" arithmetic="%s">
  <region%s>%s</region>
</fluid>
""" % (formulation, arithmetic, ' velocity="%s"' % velocity if velocity else "", region)


def histories(dim, solid=False, surfaces=""):
    """Every kind of history, a row a step."""
    place = " ".join(["0.2", "0.3", "0.2"][:dim])
    rows = ['<history name="volume" type="volume" lower="%s" upper="%s"/>' % (" ".join(["0.1"] * dim), place),
            '<history name="gauge" type="gauge" at="%s"/>' % place,
            '<history name="energy" type="energy"/>', '<history name="force" type="force" surfaces="%s"/>' % surfaces,
            '<history name="profile" type="profile" from="%s" to="%s" points="3" every="3.1*dt"/>'
            % (" ".join(["0.1"] * dim), place)]
    if solid:
        rows += ['<history name="tip" type="point" mesh="beam" at="%s"/>' % " ".join(["0.52", "0.35", "0.2"][:dim]),
                 '<history name="coupling" type="coupling"/>']
    return "".join("  %s\n" % row for row in rows)


def triangles(nx, ny, lower, upper):
    """A box of tri3 elements: nodes and elements as a deck takes them."""
    nodes = [(lower[0] + (upper[0] - lower[0]) * i / nx, lower[1] + (upper[1] - lower[1]) * j / ny)
             for j in range(ny + 1) for i in range(nx + 1)]
    elements = []
    for j, i in itertools.product(range(ny), range(nx)):
        a, b = j * (nx + 1) + i, (j + 1) * (nx + 1) + i
        elements += [(a, a + 1, b + 1), (a, b + 1, b)]
    return nodes, elements


def tetrahedra(n, lower, upper):
    """A box of tet4 elements: each cell is cut into six around its diagonal."""
    nodes, elements = [], []
    for k, j, i in itertools.product(range(n[2] + 1), range(n[1] + 1), range(n[0] + 1)):
        nodes.append(tuple(lower[d] + (upper[d] - lower[d]) * (i, j, k)[d] / n[d] for d in range(3)))

    def number(place):
        return (place[2] * (n[1] + 1) + place[1]) * (n[0] + 1) + place[0]

    for cell in itertools.product(range(n[0]), range(n[1]), range(n[2])):
        for order in itertools.permutations(range(3)):
            place, corners = list(cell), [number(cell)]
            for d in order:
                place[d] += 1
                corners.append(number(place))
            odd = sum(order[a] > order[b] for a in range(3) for b in range(a + 1, 3)) % 2
            if odd:
                corners[1], corners[2] = corners[2], corners[1]
            elements.append(tuple(corners))
    return nodes, elements


def inline(nodes, elements, kind):
    return "<nodes>%s</nodes><elements type=\"%s\">%s</elements>" % (
        "\n".join(" ".join("%.17g" % x for x in node) for node in nodes), kind,
        "\n".join(" ".join("%d" % i for i in element) for element in elements))


def beam(dim, element, formulation, moving=""):
    """A block that is held at its foot, amid the fluid."""
    lower, upper = [0.45, 0.15, 0.1][:dim], [0.6, 0.35, 0.25][:dim]
    vector = lambda x: " ".join("%g" % v for v in x)
    cells = {"quad4": "2 3", "hex8": "2 2 2"}.get(element, "1 2" if dim == 2 else "1 1 1")
    shape = '<grid type="%s" lower="%s" upper="%s" cells="%s"/>' % (element, vector(lower), vector(upper), cells)
    if element == "tri3":
        shape = inline(*triangles(2, 3, lower, upper), element)
    if element == "tet4":
        shape = inline(*tetrahedra((2, 2, 2), lower, upper), element)
    foot = upper[:1] + lower[1:2] + upper[2:]
    support = ('<support set="root">%s</support>' % moving if moving
               else '<support set="root" fixed="%s"/>' % " ".join("xyz"[:dim]))
    return """<meshes><mesh name="beam" material="rubber" formulation="%s">
  %s
  <set name="root"><box lower="%s" upper="%s"/></set>%s
</mesh></meshes>
""" % (formulation, shape, vector(lower), vector(foot), support)


def channel(dim, part):
    """Fluid over a floor, under a lid, past a block or not; periodic along x, or with openings. In 3-D periodic in z."""
    periodic = part["ends"] == "periodic"
    solid = part["element"] is not None
    lower, upper = (["0", "-4*dx", "0"] if periodic else ["-0.3", "-4*dx", "0"]), \
        (["1", "0.5+4*dx", "0.35"] if periodic else ["1.3", "0.5+4*dx", "0.35"])
    text = head(dim, ["3" if periodic else "0", "-1", "0.3"], lower, upper,
                ("x " if periodic else "") + ("z" if dim == 3 else ""), RUBBER % (part.get("law", LAWS[0]), YOUNG[dim]) if solid else "")
    box = '<box lower="%s" upper="%s"/>'
    region = box % (" ".join(["0", "0", "0"][:dim]), " ".join(["1", "0.5", "0.35"][:dim]))
    if solid:
        region = "<difference>%s%s</difference>" % (
            region, box % (" ".join(["0.45", "0.15", "0.1"][:dim]), " ".join(["0.6", "0.35", "0.25"][:dim])))
    # a body in the way of a flow that is there at once takes a blow
    flow = "4" if periodic else "16" if dim == 2 else "8"
    text += fluid(part["formulation"], part["arithmetic"], region, " ".join(["%s*y*(0.5-y)" % flow, "0.05*sin(20*x)", "0"][:dim]))
    if solid:
        text += beam(dim, part["element"], part["solid"])
    text += '<surfaces>\n  <surface name="lid"><plane point="%s" normal="%s"/></surface>\n' % (
        " ".join(["0", "0.5", "0"][:dim]), " ".join(["0", "-1", "0"][:dim]))
    text += '  <surface name="floor"><plane point="%s" normal="%s"/></surface>\n' % (
        " ".join(["0", "0", "0"][:dim]), " ".join(["0", "1", "0"][:dim]))
    if solid:
        text += '  <surface name="wet"><skin mesh="beam"/></surface>\n'
    text += '</surfaces>\n<boundaries>\n  <wall name="plates" surfaces="lid floor" treatment="%s"/>\n' % part["wall"]
    if solid:
        text += '  <wall name="wet" surfaces="wet" treatment="%s" corners="%s" pressure-gradient="%s"/>\n' % (
            part["wet"], part["corners"], part["gradient"])
    if not periodic:
        opening = 'axis="x" at="%s" into="%s" lower="%s" upper="%s"'
        low, high = " ".join(["0", "0", "0"][:dim]), " ".join(["1", "0.5", "0.35"][:dim])
        text += '  <inflow name="in" %s velocity="%s"/>\n' % (
            opening % ("0", "+", low, high), " ".join(["1.2*%s*y*(0.5-y)*(1+0.2*sin(40*t))" % flow, "0", "0"][:dim]))
        text += '  <outflow name="out" %s velocity="%s" pressure="0.2*sin(30*t)"/>\n' % (
            opening % ("1", "-", low, high), part["ends"])
    text += "</boundaries>\n"
    if solid:
        # the published rule for corners jumps where contact points come and go: it converges no further
        # checkpoints lie within steps of the solid of 4 fluid steps
        text += '<coupling scheme="%s" acceleration="%s" relaxation="%s" tolerance="%s"%s/>\n' % (
            part["scheme"], part["acceleration"], "1" if part["acceleration"] in ("added-mass", "none") else "0.7",
            "1e-3" if part["corners"] == "paper" else "1e-6", ' solid-every="4"' if part["scheme"] == "sub-cycled" else "")
        if part["corners"] == "paper":
            # its viscous term divides by a distance that vanishes at corners, exactly so on a lattice in line with them
            text = text.replace('kinematic-viscosity="0.02"', 'kinematic-viscosity="0"')
            text = text.replace("<region ", '<region origin="%s" ' % " ".join(["0.01", "0.013", "0.007"][:dim]))
    if not solid:
        return text + OUTPUT % histories(dim, False, "lid floor")
    return text + OUTPUT % histories(dim, solid, "wet lid floor")


def moving(dim, part):
    """A body that a motion moves, in a box of fluid that is periodic in all directions (so that bodies and wall
    particles leave and enter)."""
    text = head(dim, ["0", "0", "0"], ["0", "0", "0"], ["0.8", "0.8", "0.5"], " ".join("xyz"[:dim]))
    body = part["body"]
    centre = " ".join(["0.4", "0.4", "0.25"][:dim])
    if dim == 2:
        solid = '<disc centre="%s" radius="0.21"/>' % centre if body == "round" else \
            '<box lower="0.25 0.3" upper="0.55 0.5"/>'
        surface = '<circle centre="%s" radius="0.2" fluid="outside"/>' % centre if body == "round" else \
            '<segments closed="yes" fluid="right" points="0.25 0.3 0.55 0.3 0.55 0.5 0.25 0.5"/>'
    else:
        solid = '<ball centre="%s" radius="0.16"/>' % centre if body == "round" else \
            '<box lower="0.25 0.25 0.15" upper="0.55 0.55 0.35"/>'
        places = itertools.product(("0.15", "0.35"), ("0.25", "0.55"), ("0.25", "0.55"))
        surface = '<sphere centre="%s" radius="0.15" fluid="outside"/>' % centre if body == "round" else \
            '<facets><nodes>%s</nodes><elements type="quad4">%s</elements></facets>' % (
                "\n".join("%s %s %s" % (x, y, z) for z, y, x in places),
                "\n".join(["0 2 3 1", "4 5 7 6", "0 1 5 4", "2 6 7 3", "0 4 6 2", "1 3 7 5"]))
    # far and fast enough to cross the periodic side, fast enough to rebuild lists, slow enough for the fluid
    motion = {"rotation": '<rotation centre="%s"%s angle="0.2*sin(12*t)"/>' % (centre, ' axis="0 0 1"' if dim == 3 else ""),
              "translation": '<translation value="%s"/>' % " ".join(["0.7*t", "0.02*sin(30*t)", "0.4*t"][:dim]),
              "displacement": '<displacement value="%s"/>' % " ".join(["0.02*sin(20*t)*y", "0.5*t", "0"][:dim])}
    text += fluid(part["formulation"], part["arithmetic"], "<difference><box lower=\"%s\" upper=\"%s\"/>%s</difference>" % (
        " ".join(["0", "0", "0"][:dim]), " ".join(["0.8", "0.8", "0.5"][:dim]), solid))
    text += "<surfaces>\n  <surface name=\"body\">%s%s</surface>\n</surfaces>\n" % (surface, motion[part["motion"]])
    text += '<boundaries><wall name="body" surfaces="body" treatment="%s" corners="%s"/></boundaries>\n' % (
        part["wall"], part["corners"])
    return text + OUTPUT % histories(dim, False, "body")


def driven(dim, part):
    """A body of elements all of whose nodes are led, through a box of fluid that is periodic in all directions."""
    lower, upper = ["0.25", "0.3" if dim == 2 else "0.25", "0.15"][:dim], ["0.55", "0.5" if dim == 2 else "0.55", "0.35"][:dim]
    text = head(dim, ["0", "0", "0"], ["0", "0", "0"], ["0.8", "0.8", "0.5"], " ".join("xyz"[:dim]), RUBBER % (LAWS[0], YOUNG[dim]))
    text += fluid(part["formulation"], part["arithmetic"], "<difference><box lower=\"%s\" upper=\"%s\"/><inside surface=\"body\"/></difference>" % (
        " ".join(["0", "0", "0"][:dim]), " ".join(["0.8", "0.8", "0.5"][:dim])))
    box = '<box lower="%s" upper="%s"/>' % (" ".join(lower), " ".join(upper))
    motion = '<displacement value="%s"/>' % " ".join(["0.7*t+0.02*sin(20*t)*y", "0.02*sin(30*t)", "0.4*t"][:dim])
    text += """<meshes><mesh name="beam" material="rubber" formulation="full">
  <grid type="%s" lower="%s" upper="%s" cells="%s"/>
  <set name="all">%s</set><support set="all">%s</support>
</mesh></meshes>
<surfaces><surface name="body"><skin mesh="beam"/></surface></surfaces>
<boundaries><wall name="body" surfaces="body" treatment="%s"/></boundaries>
""" % (part["element"], " ".join(lower), " ".join(upper), " ".join(["2", "2", "1"][:dim]), box, motion, part["wall"])
    return text + OUTPUT % histories(dim, True, "body")


def raft(part):
    """Wall particles of a region of their own that cross a periodic side, under a fluid."""
    text = head(2, ["0", "-1", "0"], ["0", "-0.2"], ["0.6", "0.6"], "x")
    text += fluid(part["formulation"], part["arithmetic"], '<box lower="0 0" upper="0.6 0.4"/>')
    return text + """<boundaries><wall name="raft" treatment="fixed-particles">
  <region><box lower="0 -0.15" upper="0.6 0"/></region>
  <translation value="0.9*t 0"/></wall></boundaries>
""" + OUTPUT % '  <history name="volume" type="volume"/>\n'


def tube(part):
    """One dimension: a pressure wave between plates."""
    text = head(1, ["0.5"], ["-0.3"], ["1.3"], "")
    text += fluid(part["formulation"], part["arithmetic"], '<box lower="0" upper="1"/>', "0.5*sin(3*x)")
    return text + """<surfaces>
  <surface name="left"><plane point="0" normal="1"/><translation value="0.02*sin(20*t)"/></surface>
  <surface name="right"><plane point="1" normal="-1"/></surface>
</surfaces>
<boundaries><wall name="ends" surfaces="left right" treatment="%s"/></boundaries>
""" % part["wall"] + OUTPUT % ('  <history name="force" type="force" surfaces="left right"/>\n'
                               '  <history name="gauge" type="gauge" at="0.4"/>\n')


def burst(part):
    """Fluid in 3-D thrown at a wall so fast that particles get through and are put back."""
    text = head(3, ["0", "0", "0"], ["-0.3", "0", "0"], ["0.8", "0.35", "0.35"], "y z", factor=0.5)
    text += fluid(part["formulation"], part["arithmetic"], '<box lower="0 0 0" upper="0.3 0.35 0.35"/>', "-9*(1+y) 0 0")
    return text + """<surfaces><surface name="wall"><plane point="0 0 0" normal="1 0 0"/></surface></surfaces>
<boundaries><wall name="wall" surfaces="wall" treatment="sliding-particles"/></boundaries>
""" + OUTPUT % '  <history name="force" type="force" surfaces="wall"/>\n'


def alone(dim, element, formulation, support, law=LAWS[0]):
    """A solid without fluid."""
    moving_support = ('<translation value="%s"/>' % " ".join(["0.05*sin(9*t)", "0.03*t", "0"][:dim])
                      if support == "moving" else "")
    return ("""<deck version="1" dim="%d">
<parameters><parameter name="dt" value="0.004"/><parameter name="end" value="1000*dt"/></parameters>
<time end="end" step="dt"><body-force value="%s"/></time>
<materials>%s</materials>
""" % (dim, " ".join(["2*cos(t)", "-3", "1"][:dim]), RUBBER % (law, 800)) + beam(dim, element, formulation, moving_support)
            + OUTPUT.replace(' virtual-particles="3 40"', "").replace(' arrays="Vorticity Acceleration Support"', "")
            % '  <history name="tip" type="point" mesh="beam" at="%s"/>\n  <history name="energy" type="energy"/>\n'
            % " ".join(["0.52", "0.35", "0.2"][:dim]))


def floating(dim, part):
    """A rigid body in the fluid, free to go and to turn, or held in part."""
    text = channel(dim, dict(part, ends="periodic", element=ELEMENTS[dim][0], solid="eas"))
    mesh = re.search(r'<mesh name="beam".*?</mesh>', text, re.S).group(0)
    grid = re.search(r"<grid.*?/>", mesh).group(0)
    body = '<mesh name="beam">\n  %s\n  <rigid density="3"%s angular-velocity="%s"/>\n</mesh>' % (
        grid, ' fixed="y"' if part["held"] else "", " ".join(["-1.5"] if dim == 2 else ["0.4", "0.3", "-1.5"]))
    text = text.replace(mesh, body).replace(' exclude="root"', "").replace(' formulation="eas"', "")
    return text.replace("</output>", '  <history name="body" type="rigid" mesh="beam"/>\n</output>', 1)


ELEMENTS = {2: ("quad4", "tri3"), 3: ("hex8", "tet4")}


def apart(dim, part):
    """A fluid and a solid that do not touch."""
    text = channel(dim, dict(part, ends="periodic", element=None))
    mesh = beam(dim, part["element"], part["solid"])
    text = text.replace("</materials>", (RUBBER % (LAWS[0], YOUNG[dim])).strip() + "\n</materials>", 1).replace("<surfaces>", mesh + "<surfaces>", 1)
    return text.replace("</output>", '  <history name="tip" type="point" mesh="beam" at="%s"/>\n</output>'
                        % " ".join(["0.52", "0.35", "0.2"][:dim]), 1)


def all_decks(skerry, everything):
    """Pairs (name, deck) of the combinations; those that make no sense the program refuses. In 3-D not every choice goes
    with every other unless @p everything."""
    known = choices(skerry)
    treatments = known["wall"]["treatment"]
    schemes = [scheme for scheme in known["coupling"]["scheme"] if scheme != "none"]
    accelerations = known["coupling"]["acceleration"]
    ends = ["periodic"] + known["outflow"]["velocity"]
    laws = known["solid-material"]["law"]
    assert laws[0] == LAWS[0]
    kinds = {dim: [kind for kind in known["grid"]["type"] if kind.startswith(start)]
             for dim, start in ((2, ("tri", "quad")), (3, ("tet", "hex")))}
    arithmetics = itertools.cycle(known["fluid"]["arithmetic"])

    def named(kind, make, **part):
        part["arithmetic"] = next(arithmetics)
        return "-".join([kind] + [str(v) for v in part.values() if v is not None]), make(part)

    for formulation in known["fluid"]["formulation"]:
        common = {"formulation": formulation}
        for dim, wall, end in itertools.product((2, 3), treatments, ends):
            yield named("channel%d" % dim, lambda part, d=dim: channel(d, part), wall=wall, ends=end, element=None, **common)
        for wall in treatments:
            yield named("tube", tube, wall=wall, **common)
            for dim, body, motion in itertools.product((2, 3), ("round", "edged"), ("rotation", "translation", "displacement")):
                for corners in known["wall"]["corners"] if body == "edged" else ["shares"]:
                    yield named("moving%d" % dim, lambda part, d=dim: moving(d, part), wall=wall, body=body, motion=motion,
                                corners=corners, **common)
        yield named("raft", raft, **common)
        yield named("burst", burst, **common)
        for dim in (2, 3):
            kind, make = "beam%d" % dim, lambda part, d=dim: channel(d, part)
            solids = list(itertools.product(ELEMENTS[dim], known["mesh"]["formulation"]))
            yield named("apart%d" % dim, lambda part, d=dim: apart(d, part), wall=treatments[0], element=ELEMENTS[dim][0],
                        solid="eas", **common)
            first = dict(wall=treatments[0], wet=treatments[-1], ends=ends[0], element=ELEMENTS[dim][0], solid="eas",
                         corners="shares", gradient="yes", scheme=schemes[0], acceleration=accelerations[0], **common)
            for wall, end, (element, solid), scheme, acceleration in itertools.product(
                    treatments, ends, solids, schemes, accelerations):
                part = dict(first, wall=wall, ends=end, element=element, solid=solid, scheme=scheme, acceleration=acceleration)
                changed = sum(part[key] != first[key] for key in part)
                if dim == 2 or everything or changed <= 1 or (changed == 2 and end != ends[0] and wall != treatments[0]):
                    yield named(kind, make, **part)
            for element in kinds[dim]:
                yield named(kind, make, **dict(first, element=element, solid="full"))
            for wet in treatments[:-1]:
                for scheme, acceleration in itertools.product(schemes, accelerations):
                    yield named(kind, make, **dict(first, wet=wet, scheme=scheme, acceleration=acceleration))
                for end, element in itertools.product(ends[1:], kinds[dim]):
                    yield named(kind, make, **dict(first, wet=wet, ends=end, element=element, solid="full"))
            for wall in treatments:
                yield named("driven%d" % dim, lambda part, d=dim: driven(d, part), wall=wall, element=kinds[dim][-1], **common)
            for scheme, acceleration, wet, held in itertools.product(schemes, accelerations, treatments, (False, True)):
                yield named("floating%d" % dim, lambda part, d=dim: floating(d, part), **dict(
                    first, wet=wet, scheme=scheme, acceleration=acceleration, element=None, solid=None, held=held))
            for law in laws[1:]:
                yield named(kind, make, **dict(first, law=law))
            for wall, wet, corners, gradient in itertools.product(
                    treatments, treatments, known["wall"]["corners"], known["wall"]["pressure-gradient"]):
                if dim == 2 or everything or wall != treatments[0]:
                    yield named(kind, make, **dict(first, wall=wall, wet=wet, corners=corners, gradient=gradient))
    # names that could be taken for those of what belongs to another
    one = alone(2, "quad4", "eas", "fixed")
    mesh = re.search("<mesh .*</mesh>", one, re.S).group(0)
    others = "".join("\n" + mesh.replace('"beam"', '"beam%s"' % end) for end in ("-state", "-cells", "..b"))
    yield "alone2-names", one.replace(mesh, mesh + others)
    for dim in (2, 3):
        for element, solid, law, support in itertools.product(kinds[dim], known["mesh"]["formulation"], laws, ("fixed", "moving")):
            if law == laws[0] or support == "moving":
                yield ("alone%d-%s-%s-%s-%s" % (dim, element, solid, law, support),
                       alone(dim, element, solid, support, law))


def distinct(skerry, everything=False):
    """The same without repetitions (but for the arithmetic)."""
    seen = set()
    for name, text in all_decks(skerry, everything):
        key = re.sub('arithmetic="[a-z]*"', "", text)
        if key not in seen:
            seen.add(key)
            yield name, text
