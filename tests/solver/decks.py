# SPDX-License-Identifier: GPL-2.0-or-later
"""Decks of CalculiX: reading them, writing one with Gmsh's triangles, running them."""
import os
import subprocess


def read_deck(path):
    """Nodes and the sets of nodes."""
    nodes, sets, keyword, name = {}, {}, '', ''
    for line in open(path):
        if line.startswith('*'):
            keyword, name = line[1:].split(',')[0].strip(), line.strip().split('=')[-1]
            continue
        words = [word for word in line.replace(',', ' ').split()]
        if keyword == 'NODE':
            nodes[int(words[0])] = tuple(map(float, words[1:4]))
        if keyword == 'NSET':
            sets.setdefault(name, []).extend(map(int, words))
    return nodes, sets


def read_displacements(path):
    """Displacements of nodes in x, y and z, from a .frd file."""
    moves, inside = {}, False
    for line in open(path):
        if line.startswith(' -4'):
            inside = 'DISP' in line
        elif inside and line.startswith(' -1'):
            moves[int(line[3:13])] = tuple(float(line[i:i + 12]) for i in (13, 25, 37))
    return moves


def solve(deck, step):
    """Appends the step to the deck; displacements that ccx finds."""
    with open(deck, 'a') as out:
        out.write(step)
    job = deck[:-4]
    done = subprocess.run(['ccx', job], cwd=os.path.dirname(deck), capture_output=True, text=True)
    if done.returncode or '*ERROR' in done.stdout:
        raise SystemExit(f'{deck}: ccx failed\n' + done.stdout[-2000:])
    return read_displacements(job + '.frd')


def write_triangles(script, deck, element, name, order=1, scale=1):
    """A deck with Gmsh's triangles: element type, name of their set. \\return how many nodes it has."""
    import gmsh
    gmsh.initialize(['decks'], False)
    gmsh.option.setNumber('General.Terminal', 0)
    gmsh.option.setNumber('Mesh.MeshSizeFactor', scale)
    gmsh.open(script)
    gmsh.model.mesh.generate(2)
    if order > 1:
        gmsh.model.mesh.setOrder(order)
    gmsh.model.mesh.renumberNodes()
    tags, xyz, _ = gmsh.model.mesh.getNodes()
    with open(deck, 'w') as out:
        out.write('*NODE\n')
        for i, tag in enumerate(tags):
            out.write(f'{tag}, ' + ', '.join(f'{x:.13g}' for x in xyz[3 * i:3 * i + 3]) + '\n')
        out.write(f'*ELEMENT, TYPE={element}, ELSET={name}\n')
        _, elements, nodes = gmsh.model.mesh.getElements(2)
        n = len(nodes[0]) // len(elements[0])
        for i, number in enumerate(elements[0]):
            out.write(f'{number}, ' + ', '.join(map(str, nodes[0][n * i:n * i + n])) + '\n')
        for dim in (0, 1):
            for _, tag in gmsh.model.getPhysicalGroups(dim):
                out.write(f'*NSET, NSET={gmsh.model.getPhysicalName(dim, tag)}\n')
                out.writelines(f'{node}\n' for node in gmsh.model.mesh.getNodesForPhysicalGroup(dim, tag)[0])
    gmsh.finalize()
    return len(tags)
