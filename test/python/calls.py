"""What ../fortran/calls.cpp does, through rsc.py: the same calls in the same order, every value they give back printed in the same words."""
import math
import struct

import numpy as np

import rsc

NAN, INF = math.nan, math.inf
scene = ""


def one(value):
    """A number or a text as calls.cpp prints it."""
    if isinstance(value, str):
        return value.replace("\n", "|").rstrip(" ")
    if isinstance(value, (bool, int, np.integer)):
        return str(int(value))
    return struct.pack(">d", value).hex().upper()


def put(what, value):
    print(scene, what, *[one(v) for v in (np.ravel(value) if isinstance(value, np.ndarray) else [value])])


def record(function, values, **names):
    """Every field of a named tuple under the name of the argument of rsc.h."""
    for name, value in values._asdict().items():
        put(f"{function}.{names.get(name, name)}", value)


def told(function, call, *arguments, **more):
    """Calls, and prints what was raised, if anything; None then."""
    try:
        return call(*arguments, **more)
    except rsc.Error as error:
        put(function + ".code", f"{error.status} {error}")
        kind = rsc.ArgumentError if error.status < 0 else rsc.NotConverged if error.status == rsc.NOT_CONVERGED else rsc.Error
        if type(error) is not kind:
            put(function, f"{type(error)} raised")
        return None


def noise(k, s):
    return (k * k * s + 29 * k + 7 * s) % 61 / 64


def take_list(bent=False):
    k = range(1, 36)
    x = [-0.25 + 0.25 * ((i - 1) % 5) + noise(i, 1) / 8 for i in k]
    y = [0.5 + 0.375 * ((i - 1) // 5) + noise(i, 2) / 8 for i in k]
    kappa2 = [1.5 + noise(i, 5) for i in k]
    more = {}
    if bent:
        more = {"kappa1": [kappa2[i - 1] + 0.25 + noise(i, 6) for i in k], "kappa2": kappa2, "angle": [noise(i, 7) - 0.5 for i in k],
                "biharmonic": [400 + 256 * noise(i, 8) for i in k]}
    return rsc.Asperities.take(x, y, [noise(i, 3) / 16 for i in k], [0.25 + noise(i, 4) / 4 for i in k], **more)


def read_asperities(asperities):
    put("rsc_asperities_count.n", len(asperities))
    record("rsc_asperities_get", asperities.get())
    curvatures = told("rsc_asperities_curvatures", asperities.curvatures)
    if curvatures is not None:
        record("rsc_asperities_curvatures", curvatures)


def read_surface(surface):
    record("rsc_surface_grid", surface.grid())
    put("rsc_surface_heights.heights", surface.heights())
    record("rsc_surface_moments", surface.moments())


def tip(contact):
    for name, value in zip(("x0", "y0"), contact.tip):
        put("rsc_contact_tip." + name, value)
    put("rsc_contact_first_touch.separation", contact.first_touch())


def read_contact(contact, elements=False):
    for name in ("separation", "force", "area", "contacts"):
        put("rsc_contact_result." + name, getattr(contact, name))
    record("rsc_contact_level", contact.level(), status="level_status")
    put("rsc_contact_stiffness.stiffness", contact.stiffness())
    put("rsc_contact_energy.energy", contact.energy())
    record("rsc_contact_answer", contact.answer(), status="level_status")
    for name in ("moment_x", "moment_y", "nominal_area", "products"):
        put("rsc_contact_value.value", contact.value(name))
    record("rsc_contact_spots", contact.spots())
    if not elements:
        for name, value in list(contact.per_asperity()._asdict().items())[1:]:
            put("rsc_contact_per_asperity." + name, value)
    put("rsc_contact_deflection.deflection", contact.deflection([0.25, 0.375, 0.75], [1.25, 0.875, 1.0]))


def indent(contact, separation):
    force = told("rsc_contact_indent", contact.indent, separation)
    put("rsc_contact_indent.force", contact.force if force is None else force)


def press(contact, force):
    separation = told("rsc_contact_press", contact.press, force)
    put("rsc_contact_press.separation", contact.separation if separation is None else separation)


def texts():
    put("rsc_version.buffer", rsc.version())
    names = rsc.keys()
    put("rsc_key_count.count", len(names))
    for name in names:
        put("rsc_key_name.buffer", name)


def namelist(value):
    if isinstance(value, tuple):
        return ", ".join(map(namelist, value))
    if isinstance(value, bool):
        return f".{value}.".lower()
    return "'" + value.replace("'", "''") + "'" if isinstance(value, str) else repr(value)


def get(case, name):
    put("rsc_case_get.buffer", namelist(case[name]))


def cases():
    case = rsc.Case()
    for name, value in {"surface%sigma": 0.1 + 0.2, "surface%hurst": 0.1, "surface%n": 4096, "run%seed": 9000000000, "surface%plateau": True, "solids%E": [0.1, 0.7],
                        "solids%nu": np.array([0.1, 0.3]), "indentation%levels": (3, 2, 1), "solver%method": "direct", "run%title": "it's", "indentation%centre(2)": 0.625,
                        "output%heights": False}.items():
        case[name] = value
        get(case, name)
    case["surface%file"] = "f" * 4096
    get(case, "surface%file")
    put("rsc_case_text.buffer", case.text())
    other = case.copy()
    case["surface%sigma"] = 0.03125
    get(other, "surface%sigma")
    told("rsc_case_set", case.__setitem__, "surface%simga", 1)
    told("rsc_case_set", case.__setitem__, "surface%sigma", -1)
    told("rsc_case_get", case.__getitem__, "surface%simga")
    told("rsc_case_read", case.read, "&surface n=3 /")
    told("rsc_case_read_file", case.read_file, "no/such/file.nml")
    get(case, "surface%sigma")
    case.read("&surface n=128, L_lambda_l=4, L_lambda_s=32, sigma=0.25 / &solids nu=0.1, 0.2 /")
    put("rsc_case_text.buffer", str(case))
    other.read_file("calls.nml")
    put("rsc_case_text.buffer", other.text())
    try:
        other.run()
    except rsc.NotConverged as error:
        put("rsc_case_run.code", f"{error.status} {error}")
        put("rsc_case_run.failed_levels", error.failed_levels)
    other["surface%n"] = 16
    told("rsc_case_run", other.run)


def surfaces():
    global scene
    z = np.array([[noise(i + 9 * j, 9) / 8 + (i * i - 2 * i * j) / 256 + j / 64 for i in range(1, 10)] for j in range(1, 8)])
    case = rsc.Case("&asperities curvature='algebraic' /")
    for periodic in (True, False):
        surface = rsc.Surface.take(z, 0.125, 0.1875, -0.5, 0.75, periodic)
        read_surface(surface)
        read_asperities(rsc.Asperities.find(surface))
        read_asperities(rsc.Asperities.find(surface, case))
    other = surface.copy()
    scene = "forms"
    for how in ("none", "mean", "plane", "quadratic", "sphere", "cubic"):
        rms = told("rsc_surface_detrend", surface.detrend, how)
        if rms is not None:
            put("rsc_surface_detrend.rms", rms)
    read_surface(surface)
    surface.filter(0.3125)
    told("rsc_surface_filter", surface.filter, -1.0)
    read_surface(surface)
    read_surface(other)
    scene = "surfaces"
    for grid in ((0.0, 0.1875, -0.5, 0.75), (0.125, -1.0, -0.5, 0.75), (0.125, 0.1875, NAN, 0.75), (0.125, 0.1875, -0.5, INF)):
        told("rsc_surface_take", rsc.Surface.take, z, *grid)
    z[0, 5] = NAN
    told("rsc_surface_take", rsc.Surface.take, z, 0.125, 0.1875, -0.5, 0.75)


def synthetic():
    case = rsc.Case("&surface n=64, L=1.5, L_lambda_l=2, L_lambda_s=8, sigma=0.03125 / &run seed=5 / &solids E=1e3, 3e3  nu=0.125, 0.375  R=3.0, 5.0  resistivity=1e-5, 3e-5 / "
                    "&indentation centre=0.625, 0.875 /")
    for number in ((3,), ()):  # the first is the one that is not named
        read_surface(rsc.Surface.synthesize(case, *number))
        made = rsc.Asperities.make(case, *number)
        read_asperities(made)
    other = made.copy()
    read_asperities(other)
    contact = rsc.Contact.from_case(other, case)
    tip(contact)
    indent(contact, 0.03125)
    read_contact(contact, True)
    put("rsc_contact_value.value", contact.value("resistance"))
    case["surface%n"] = 16
    told("rsc_surface_synthesize", rsc.Surface.synthesize, case, 1)
    told("rsc_asperities_make", rsc.Asperities.make, case, 1)
    case["solver%model"] = "elements"
    told("rsc_contact_create_from_case", rsc.Contact.from_case, other, case)


def list_of_asperities():
    case = rsc.Case("&solver tolerance=1e-9 / &surface L=4.0 /")
    asperities = take_list()
    read_asperities(asperities)
    contact = rsc.Contact(asperities, 3e3, 4.0, 0.4375, 1.25, case)
    tip(contact)
    told("rsc_contact_result", lambda: contact.area)
    told("rsc_contact_press", contact.press, -1.0)
    indent(contact, 0.0)
    read_contact(contact)
    press(contact, 8.0)
    read_contact(contact)
    contact.tip = 0.5, 0.9375
    tip(contact)
    read_contact(contact)
    other = contact.copy()
    tip(other)
    told("rsc_contact_energy", other.energy)
    for one_of_them in (contact, other):
        indent(one_of_them, -0.015625)
        read_contact(one_of_them)
    told("rsc_contact_indent", contact.indent, NAN)
    told("rsc_contact_press", contact.press, -1.0)
    for place in ((1e3, 1.0), (NAN, 1.0), (1.0, INF)):
        told("rsc_contact_move_tip", setattr, contact, "tip", place)
    told("rsc_contact_deflection", contact.deflection, [0.25, NAN], [0.5, 0.75])
    told("rsc_contact_deflection", contact.deflection, [0.5, 0.75], [0.25, NAN])
    told("rsc_contact_value", contact.value, "nothing")
    tip(contact)
    read_contact(contact)
    for wrong in ((-1.0, 4.0, 0.5, 1.0), (3e3, 0.0, 0.5, 1.0), (3e3, 4.0, NAN, 1.0), (3e3, 4.0, 0.5, NAN)):
        told("rsc_contact_create", rsc.Contact, asperities, *wrong, case)
    case["solver%model"] = "elements"
    told("rsc_contact_create", rsc.Contact, asperities, 3e3, 4.0, 0.5, 1.0, case)
    told("rsc_asperities_take", rsc.Asperities.take, [1.0], [0.5], [0.0], [0.0])
    told("rsc_asperities_take", rsc.Asperities.take, *[[1.0, 1.0]] * 4)


def kept():
    asperities = take_list()
    contact = rsc.Contact(asperities, 3e3, 4.0, 0.4375, 1.25)
    indent(contact, 0.0)
    contact.tip = 0.5, 0.9375
    contact.save("contact.kept")
    contact = rsc.Contact.restore(asperities, "contact.kept")
    tip(contact)
    read_contact(contact)
    indent(contact, -0.015625)
    read_contact(contact)
    told("rsc_contact_save", contact.save, "no/folder/contact.kept")
    told("rsc_contact_restore", rsc.Contact.restore, asperities, "nothing.kept")
    told("rsc_contact_restore", rsc.Contact.restore, take_list(True), "contact.kept")


def curved():
    given = [1.0], [0.5], [0.0], [1.0]
    told("rsc_asperities_take", rsc.Asperities.take, *given, [0.5], [1.0], [0.0])
    told("rsc_asperities_take", rsc.Asperities.take, *given, [1.0], [0.0], [0.0])
    told("rsc_asperities_take", rsc.Asperities.take, *given, kappa1=[1.0], angle=[0.0])
    asperities = take_list(True)
    read_asperities(asperities)
    for L, R, separation in ((4.0, INF, 0.015625), (2.5, 4.0, -0.28125)):
        contact = rsc.Contact(asperities, 3e3, R, 0.4375, 1.25, rsc.Case({"asperities%law": "fourth_order", "surface%L": L}))
        indent(contact, separation)
        read_contact(contact)
    contact = rsc.Contact.from_case(asperities, rsc.Case("&solids hardness=512.0 / &surface L=4.0 /"))
    for separation in (0.015625, 0.0, 0.0078125):
        indent(contact, separation)
        for name in ("plastic_contacts", "plastic_work"):
            put("rsc_contact_value.value", contact.value(name))
    told("rsc_contact_save", contact.save, "soft.kept")
    told("rsc_friction_create", rsc.Friction, contact, 0.3125, 0.8125)


def flats(elements):
    case = rsc.Case("&surface L=2, n=64, L_lambda_l=2, L_lambda_s=8, sigma=0.015625 / &solver tolerance=1e-9 / "
                    "&solids E=3, 5  nu=0.125, 0.25  R=Infinity, Infinity / &indentation boundary='periodic' /")
    if elements:
        case["solver%model"] = "elements"
    on = rsc.Asperities.find(rsc.Surface.synthesize(case, 2), case)
    read_asperities(on)
    contact = rsc.Contact.from_case(on, case)
    tip(contact)
    press(contact, 0.0625)
    read_contact(contact, True)
    if elements:
        told("rsc_contact_per_asperity", contact.per_asperity)
        told("rsc_contact_save", contact.save, "elements.kept")


def update(friction, *to):
    numbers = told("rsc_friction_update", friction.update, *to)
    if numbers is None:  # not converged: the last iterate can be read
        state = friction.state()
        numbers = state.force, state.force_x, state.force_y, state.lost
    for name, value in zip(("force", "force_x", "force_y", "lost"), numbers):
        put("rsc_friction_update." + name, value)


def unfinished():
    case = rsc.Case("&solver max_iterations=1, tolerance=1e-14 /")
    contact = rsc.Contact(take_list(), 3e3, 4.0, 0.4375, 1.25, case)
    indent(contact, 0.0)
    read_contact(contact)
    press(contact, 8.0)
    read_contact(contact)
    case["solids%friction"] = 0.25
    update(rsc.Friction.from_case(contact, case), 0.0, 0.5, 0.25)


def many():
    few, asperities = rsc.Case("&solver max_iterations=1, tolerance=1e-14 /"), take_list()
    contacts = [rsc.Contact(asperities, 3e3, 4.0, 0.375 + 0.125 * k, 1.25 - 0.0625 * k, few if k == 1 else None) for k in range(3)]
    for function, what, call, given in (("rsc_contacts_indent", "force", rsc.indent_all, [0.0, 0.015625, -0.015625]),
                                        ("rsc_contacts_press", "separation", rsc.press_all, [4.0, 6.0, 9.0])):
        answers, statuses = call(contacts, given, 2)
        put(function + ".code", "1 contact 1: the solver did not reach its tolerance; the results are those of its last iterate")  # no error here
        put(f"{function}.{what}", answers)
        put(function + ".status", statuses)
    told("rsc_contacts_press", rsc.press_all, contacts, [5.0, -1.0, 7.0])


def read_friction(friction):
    record("rsc_friction_state", friction.state())
    for name, value in zip(("xx", "xy", "yx", "yy"), friction.stiffness().ravel()):
        put("rsc_friction_stiffness." + name, value)
    for name, value in zip(("slide", "force"), friction.full_slip()):
        put("rsc_friction_full_slip." + name, value)
    put("rsc_friction_first_loading.force", friction.first_loading([0.0, 0.00390625, 0.0078125]))
    put("rsc_friction_slide.slide", friction.slide(1.25))
    record("rsc_friction_spots", friction.spots())


def frictions():
    global scene
    E, nu = [1e3, 3e3], [0.125, 0.375]
    put("rsc_tangential_ratio.ratio", rsc.stiffness_ratio(E, nu))
    told("rsc_tangential_ratio", rsc.stiffness_ratio, E, [0.125, 0.625])
    told("rsc_tangential_ratio", rsc.stiffness_ratio, [INF, INF], nu)
    asperities = take_list()
    contact = rsc.Contact(asperities, 3e3, 4.0, 0.4375, 1.25)
    told("rsc_friction_create", rsc.Friction, contact, -1.0, 0.8125)
    told("rsc_friction_create", rsc.Friction, contact, 0.3125, 0.0)
    friction = rsc.Friction(contact, 0.3125, 0.8125)
    told("rsc_friction_state", friction.state)
    update(friction, 0.015625, 0.5, 0.25)
    update(friction, 0.0, 0.501953125, 0.25)
    update(friction, 0.00390625, 0.5029296875, 0.251953125)
    read_friction(friction)
    friction.commit()
    update(friction, 0.0, 0.5, 0.25390625)
    read_friction(friction)
    other = friction.copy()
    friction.rollback()
    record("rsc_friction_state", friction.state())
    record("rsc_friction_state", other.state())
    other.save("friction.kept")
    update(other, 0.001953125, 0.515625, 0.25)
    read_friction(other)
    other = rsc.Friction.restore(asperities, "friction.kept")
    record("rsc_friction_state", other.state())
    other.rollback()
    record("rsc_friction_state", other.state())
    for wrong in ((NAN, 0.5, 0.25), (0.0, NAN, 0.25), (0.0, 0.5, NAN)):
        told("rsc_friction_update", friction.update, *wrong)
    told("rsc_friction_slide", friction.slide, 1e6)
    told("rsc_friction_first_loading", friction.first_loading, [-1.0])
    record("rsc_friction_state", friction.state())
    told("rsc_friction_save", friction.save, "no/folder/friction.kept")
    told("rsc_friction_restore", rsc.Friction.restore, asperities, "nothing.kept")
    scene = "friction_case"
    friction = rsc.Friction.from_case(contact, rsc.Case("&solids E=1e3, 3e3  nu=0.125, 0.375  friction=0.1875 /"))
    update(friction, 0.0, 0.5, 0.25)
    update(friction, 0.0, 0.501953125, 0.2490234375)
    friction.commit()
    update(friction, 0.00390625, 0.53125, 0.2490234375)
    friction.rollback()
    update(friction, 0.00390625, 0.5, 0.2490234375)


for scene, play in (("texts", texts), ("cases", cases), ("surfaces", surfaces), ("synthetic", synthetic), ("list", list_of_asperities), ("kept", kept), ("curved", curved),
                    ("flats", lambda: flats(False)), ("elements", lambda: flats(True)), ("unfinished", unfinished), ("many", many), ("friction", frictions)):
    play()
